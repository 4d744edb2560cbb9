#include "tests/measured/run_check_cases.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace flexarm::measured {

using response::RandomNumbers;

namespace {

constexpr std::uint64_t kRunStep = 100'000'000;
constexpr double kLeastPlanted = 0.05;

RecordedRun recorded(const DrawnRun& run, const arm::Payload& stated) {
  return {run.fine, stated, run.description};
}

/// Noise that is the same in all runs: a share of the sensor's smallest deviation. Of the sensor
/// `channel` in the run `odd`, that many `times` as much, and kLeastPlanted of its deviation there.
void add_noise(std::vector<RecordedRun>& runs, double share, RandomNumbers& random,
               std::size_t odd = 0, const std::string& channel = {}, double times = 1.0) {
  std::map<std::string, double> noise;
  for (const auto& run : runs) {
    for (const Channel& one : run.record.channels) {
      const double own = share * deviation(one.values);
      double& least = noise.try_emplace(arm::to_string(one.sensor), own).first->second;
      least = std::min(least, own);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (Channel& one : runs[i].record.channels) {
      const std::string name = arm::to_string(one.sensor);
      double own = noise.at(name);
      if (i == odd && name == channel && times > 1.0) {
        own = std::max(times * own, kLeastPlanted * deviation(one.values));
      }
      for (double& value : one.values) value += own * random.normal();
    }
  }
}

}  // namespace

RecordedRuns plant_wrong_payload(std::uint64_t seed, bool odd) {
  RandomNumbers random(seed, 4);
  arm::Arm arm = draw_arm(random);
  const double beam_kg = arm.beam.linear_density_kg_per_m() * arm.beam.length_m;
  RecordedRuns made;
  double noise = 0.0;
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
    const DrawnRun run = draw_run(seed + kRunStep * (i + 1), needs);
    made.runs.push_back(recorded(run, stated));
    if (i == 0) {
      noise = run.noise;
      made.arms = known_arms(run, seed);
      made.arms.payload = stated;
    }
  }
  add_noise(made.runs, noise, random);
  return made;
}

RecordedRuns plant_uneven_noise(std::uint64_t seed, bool odd) {
  RandomNumbers random(seed, 5);
  RecordedRuns made;
  const std::size_t count = 2 + random.below(3);
  made.run = random.below(count);
  CaseNeeds needs;
  needs.sensors = {chance(random, 0.5) ? arm::SensorKind::hub_angle
                                       : arm::SensorKind::tip_acceleration};
  needs.arm = draw_arm(random);
  double noise = 0.0;
  double period_s = 0.0;
  for (std::uint64_t draw = 1; made.runs.size() < count; ++draw) {
    const DrawnRun run = draw_run(seed + kRunStep * draw, needs);
    const double own_s = sampling_period_s(run.fine);
    if (made.runs.empty()) {
      period_s = own_s;
      noise = run.noise;
      made.arms = known_arms(run, seed);
      made.arms.payload = needs.arm->payload;
      for (const Channel& channel : run.fine.channels) needs.sensors.push_back(channel.sensor.kind);
    }
    // One recorder for all runs.
    if (std::max(own_s / period_s, period_s / own_s) > 1.01) continue;
    made.runs.push_back(recorded(run, needs.arm->payload));
  }
  // A strain gauge is at another place in each run.
  std::vector<std::string> channels;
  for (const Channel& channel : made.runs.front().record.channels) {
    if (channel.sensor.kind != arm::SensorKind::strain) {
      channels.push_back(arm::to_string(channel.sensor));
    }
  }
  made.channel = channels[random.below(channels.size())];
  add_noise(made.runs, noise, random, made.run, made.channel,
            odd ? log_between(random, 5.0, 20.0) : 1.0);
  return made;
}

}  // namespace flexarm::measured
