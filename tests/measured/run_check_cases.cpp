#include "tests/measured/run_check_cases.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace flexarm::measured {

using response::RandomNumbers;

RecordedRuns plant_wrong_payload(std::uint64_t seed, bool odd) {
  constexpr std::uint64_t kRunStep = 100'000'000;
  constexpr double kMostNoise = 0.03;  // of a channel's deviation
  RandomNumbers random(seed, 4);
  arm::Arm arm = draw_arm(random);
  const double beam_kg = arm.beam.linear_density_kg_per_m() * arm.beam.length_m;
  RecordedRuns made;
  std::map<std::string, double> noise;  // of each sensor, the same in all runs
  const std::size_t count = 2 + random.below(3);
  made.run = random.below(count);
  const bool is_same = chance(random, 0.5);
  CaseNeeds needs;
  needs.sensors = {arm::SensorKind::hub_angle};
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && !is_same) arm.payload.mass_kg = beam_kg * log_between(random, 0.1, 0.8);
    const arm::Payload stated = arm.payload;
    needs.arm = arm;
    if (odd && i == made.run) {
      // Half of it, twice of it or more, left off, or another where none is stated.
      double& mass_kg = needs.arm->payload.mass_kg;
      if (mass_kg < 0.1 * beam_kg) {
        mass_kg = beam_kg * log_between(random, 0.15, 0.8);
      } else {
        mass_kg *= chance(random, 0.5) ? between(random, 0.0, 0.6) : between(random, 1.6, 3.0);
      }
      made.mass_kg = mass_kg;
    }
    DrawnRun run = draw_run(seed + kRunStep * (i + 1), needs);
    for (const Channel& channel : run.fine.channels) {
      noise.try_emplace(arm::to_string(channel.sensor), run.noise * deviation(channel.values));
    }
    TimeRecord record = run.fine;
    for (Channel& channel : record.channels) {
      const double own = std::min(noise.at(arm::to_string(channel.sensor)),
                                  kMostNoise * deviation(channel.values));
      for (double& value : channel.values) value += own * random.normal();
    }
    made.runs.push_back({std::move(record), stated, run.description});
    if (i == 0) {
      made.arms = known_arms(run, seed);
      made.arms.payload = stated;
    }
  }
  return made;
}

}  // namespace flexarm::measured
