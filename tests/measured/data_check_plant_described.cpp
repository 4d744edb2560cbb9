#include "tests/measured/data_check_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

namespace {

using response::RandomNumbers;

/// A drawn run whose arm is described, recorded.
PlantedFault described_run(std::uint64_t seed, RandomNumbers& random, const CaseNeeds& needs = {}) {
  const DrawnRun run = draw_run(seed, needs);
  PlantedFault result;
  result.record = sampled(run, random);
  result.options = known_arm(run, seed);
  result.last_sample = result.record.time_s.size() - 1;
  result.description = run.description;
  return result;
}

}  // namespace

PlantedFault plant_clock_rate(std::uint64_t seed, RandomNumbers& random) {
  PlantedFault result = described_run(seed, random);
  const double factors[] = {2.0, 0.5, 4.0, 10.0};
  const double factor = factors[random.below(4)];
  for (double& time_s : result.record.time_s) time_s *= factor;
  result.channel = "time";
  result.value = factor;
  result.description += fmt::format(", clock times {}", factor);
  return result;
}

PlantedFault plant_offset(std::uint64_t seed, RandomNumbers& random) {
  // A sensor, or the torque beside a sensor of the hub.
  const bool is_torque = chance(random, 0.3);
  PlantedFault result = described_run(
      seed, random,
      {is_torque ? std::vector{arm::SensorKind::hub_angle} : std::vector<arm::SensorKind>{}});
  if (is_torque) {
    auto& torque_N_m = result.record.torque_N_m;
    result.value =
        (chance(random, 0.5) ? 1.0 : -1.0) * deviation(torque_N_m) * log_between(random, 0.25, 2.0);
    for (double& value : torque_N_m) value += result.value;
    result.channel = "torque";
    result.description += fmt::format(", torque plus {}", result.value);
    return result;
  }
  Channel& channel = result.record.channels[random.below(result.record.channels.size())];
  result.value = (chance(random, 0.5) ? 1.0 : -1.0) * deviation(channel.values) *
                 log_between(random, 0.25, 4.0);
  for (double& value : channel.values) value += result.value;
  result.channel = arm::to_string(channel.sensor);
  result.description += fmt::format(", {} plus {}", result.channel, result.value);
  return result;
}

PlantedFault plant_late_sensor(std::uint64_t seed, RandomNumbers& random) {
  PlantedFault result = described_run(
      seed, random, {{arm::SensorKind::tip_acceleration, arm::SensorKind::hub_angle}});
  auto& channels = result.record.channels;
  Channel& channel = *std::ranges::find(channels, arm::SensorKind::tip_acceleration,
                                        [](const Channel& one) { return one.sensor.kind; });
  const std::size_t late = 2 + random.below(9);
  std::vector<double>& values = channel.values;
  values.insert(values.begin(), late, values.front());
  values.resize(result.record.time_s.size());
  result.channel = "tip_acceleration";
  result.value = static_cast<double>(late) * (result.record.time_s[1] - result.record.time_s[0]);
  result.description += fmt::format(", tip_acceleration late by {} samples", late);
  return result;
}

PlantedFault plant_wrong_scale(std::uint64_t seed, RandomNumbers& random) {
  PlantedFault result = described_run(seed, random, {{arm::SensorKind::hub_angle}});
  const double torque_factors[] = {1.3, 2.0, 1.0 / 1.3, 0.5};
  const bool is_torque = chance(random, 0.5);
  // One sensor beside the torque does not tell which of the two it is.
  if (is_torque || result.record.channels.size() == 1) {
    result.value = torque_factors[random.below(4)];
    for (double& value : result.record.torque_N_m) value *= result.value;
    result.channel = "torque";
  } else {
    auto& channels = result.record.channels;
    Channel& channel = channels[random.below(channels.size())];
    result.value = log_between(random, 1.3, 2.5);
    if (chance(random, 0.5)) result.value = 1.0 / result.value;
    for (double& value : channel.values) value *= result.value;
    result.channel = arm::to_string(channel.sensor);
  }
  result.description += fmt::format(", {} times {}", result.channel, result.value);
  return result;
}

}  // namespace flexarm::measured
