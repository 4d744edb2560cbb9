#include "tests/measured/data_check_plant.hpp"

#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace flexarm::measured {

namespace {

using arm::SensorKind;
using response::RandomNumbers;

constexpr auto kAngle = SensorKind::hub_angle;
constexpr auto kVelocity = SensorKind::hub_velocity;
constexpr auto kAcceleration = SensorKind::tip_acceleration;
constexpr auto kDisplacement = SensorKind::tip_displacement;
constexpr auto kDeflection = SensorKind::tip_deflection;
constexpr auto kStrain = SensorKind::strain;

constexpr double kNoisy = 0.03;
/// Derivatives of an angle or a displacement amplify its noise.
constexpr double kLeastNoisy = 0.01;
/// Tip acceleration has modes above 125 Hz, which fold down at lower rates.
constexpr double kUnfolded_Hz = 400.0;

template <class T>
const T& any_of(RandomNumbers& random, const std::vector<T>& items) {
  return items[random.below(items.size())];
}

Channel& channel_of(TimeRecord& record, SensorKind kind) {
  const auto found = std::ranges::find(record.channels, kind,
                                       [](const Channel& channel) { return channel.sensor.kind; });
  if (found == record.channels.end()) throw std::logic_error("a sensor that was not asked for");
  return *found;
}

PlantedFault saturation(std::uint64_t seed, RandomNumbers& random) {
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  auto& channel = any_channel(result.record, random);
  in(result, channel);
  const bool both = chance(random, 0.5);
  std::vector<double> sizes = channel.values;
  if (both) {
    for (auto& value : sizes) value = std::abs(value);
  }
  const double share =
      std::max(log_between(random, 0.01, 0.2), 12.0 / static_cast<double>(sizes.size()));
  const double limit = quantile(std::move(sizes), 1.0 - share);
  result.first_sample = channel.values.size();
  for (std::size_t k = 0; k < channel.values.size(); ++k) {
    auto& value = channel.values[k];
    if (value < limit && !(both && value <= -limit)) continue;
    value = value > 0.0 || !both ? limit : -limit;
    result.first_sample = std::min(result.first_sample, k);
    result.last_sample = k;
  }
  result.description += fmt::format(", {} of {} clipped", share, result.channel);
  return result;
}

PlantedFault dead_channel(std::uint64_t seed, RandomNumbers& random) {
  const auto beside = any_of(random, std::vector{kAngle, kAcceleration, kDisplacement});
  const auto run = draw_run(seed, {{kVelocity, beside}});
  auto result = planted(run, sampled(run, random));
  auto& channel = any_channel(result.record, random);
  in(result, channel);
  const double size = deviation(channel.values) * log_between(random, 1e-4, 1.0);
  const std::size_t how = random.below(3);
  const double offset = chance(random, 0.5) ? 0.0 : size * between(random, -3.0, 3.0);
  for (std::size_t k = 0; k < channel.values.size(); ++k) {
    double value = offset;
    if (how > 0) value += size * random.normal();
    if (how > 1)
      value += 3.0 * size * std::sin(2.0 * std::numbers::pi * 50.0 * result.record.time_s[k] + 1.0);
    channel.values[k] = value;
  }
  result.description += fmt::format(", {} dead: {}", result.channel, how);
  return result;
}

PlantedFault stuck_values(std::uint64_t seed, RandomNumbers& random) {
  const auto beside = any_of(random, std::vector{kAngle, kAcceleration, kDisplacement});
  const auto run = draw_run(seed, {{kVelocity, beside}});
  auto result = planted(run, sampled(run, random));
  auto& channel = any_channel(result.record, random);
  in(result, channel);
  const std::size_t samples = channel.values.size();
  const auto count =
      static_cast<std::size_t>(log_between(random, 8.0, 0.1 * static_cast<double>(samples)));
  const std::size_t at = random.below(samples - count - 1);
  for (std::size_t k = 1; k < count; ++k) channel.values[at + k] = channel.values[at];
  result.first_sample = at;
  result.last_sample = at;
  result.description += fmt::format(", {} stuck for {} at {}", result.channel, count, at);
  return result;
}

PlantedFault quantisation(std::uint64_t seed, RandomNumbers& random) {
  auto run = draw_run(seed);
  const std::size_t which = random.below(run.fine.channels.size());
  auto result = planted(run, sampled(run, random));
  auto& channel = result.record.channels[which];
  in(result, channel);
  const double step = deviation(channel.values) * log_between(random, 0.06, 0.6);
  for (auto& value : channel.values) value = step * std::round(value / step);
  result.description += fmt::format(", {} in steps of {}", result.channel, step);
  return result;
}

PlantedFault drift(std::uint64_t seed, RandomNumbers& random) {
  const auto kind = any_of(random, std::vector{kAngle, kAcceleration, kDeflection, kStrain});
  std::vector<SensorKind> needs = {kind};
  if (kind == kAngle) needs.push_back(kVelocity);
  const auto run = draw_run(seed, {needs});
  auto result = planted(run, sampled(run, random));
  auto& channel = channel_of(result.record, kind);
  in(result, channel);
  const double size = (chance(random, 0.5) ? 1.0 : -1.0) * deviation(channel.values) *
                      log_between(random, 1.5, 6.0);
  const bool warms_up = chance(random, 0.5);
  const auto samples = static_cast<double>(channel.values.size());
  for (std::size_t k = 0; k < channel.values.size(); ++k) {
    const double share = static_cast<double>(k) / samples;
    channel.values[k] += size * (warms_up ? std::expm1(-3.0 * share) / std::expm1(-3.0) : share);
  }
  result.description += fmt::format(", {} drifts by {}", result.channel, size);
  return result;
}

PlantedFault swapped_channels(std::uint64_t seed, RandomNumbers& random) {
  const std::vector<std::vector<SensorKind>> pairs = {{kAngle, kVelocity},
                                                      {kVelocity, kAcceleration, kAngle},
                                                      {kAngle, kStrain, kVelocity},
                                                      {kAcceleration, kDisplacement},
                                                      {kAcceleration, kDeflection, kDisplacement},
                                                      {kAcceleration, kStrain},
                                                      {kVelocity, kDeflection, kAngle}};
  const auto& pair = any_of(random, pairs);
  const bool sized =
      std::ranges::count(pair, kStrain) > 0 && std::ranges::count(pair, kAcceleration) > 0;
  const bool twice_derived = std::ranges::count(pair, kDisplacement) > 0;
  const auto run = draw_run(
      seed, {pair, 1, 400, sized ? kNoisy : kLeastNoisy, twice_derived ? kUnfolded_Hz : 0.0});
  auto result = planted(run, sampled(run, random));
  auto& a = channel_of(result.record, pair[0]);
  auto& b = channel_of(result.record, pair[1]);
  std::swap(a.values, b.values);
  in(result, a);
  result.description +=
      fmt::format(", {} and {} exchanged", result.channel, arm::to_string(b.sensor));
  return result;
}

PlantedFault sign_flipped(std::uint64_t seed, RandomNumbers& random) {
  // The last two are told by the described arm alone.
  const std::vector<std::vector<SensorKind>> needs = {
      {kAngle, kVelocity},
      {kVelocity, kAngle},
      {kAngle, kVelocity, kAngle},  // the torque, below
      {kAcceleration, kAngle, kVelocity, kDisplacement},
      {kDisplacement, kAcceleration, kAngle},
      {kDeflection, kDisplacement, kAngle},
      {kStrain, kAcceleration, kDeflection, kAngle},
      {kAcceleration, kVelocity},
      {kAcceleration, kAngle}};
  const std::size_t which = random.below(needs.size());
  const auto run = draw_run(seed, {needs[which]});
  auto result = planted(run, sampled(run, random));
  if (which + 2 >= needs.size()) result.options = known_arm(run, seed);
  auto& values =
      which == 2 ? result.record.torque_N_m : channel_of(result.record, needs[which][0]).values;
  result.channel =
      which == 2 ? "torque" : arm::to_string(channel_of(result.record, needs[which][0]).sensor);
  for (auto& value : values) value = -value;
  result.description += fmt::format(", {} flipped", result.channel);
  return result;
}

PlantedFault wrong_unit(std::uint64_t seed, RandomNumbers& random) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  struct Slip {
    std::vector<SensorKind> sensors;
    double factor;
  };
  const std::vector<Slip> slips = {{{kAngle, kVelocity, kDisplacement}, kDegrees},
                                   {{kAngle, kVelocity, kDisplacement}, 1000.0},
                                   {{kVelocity, kAngle, kDisplacement}, kDegrees},
                                   {{kVelocity, kAngle, kDisplacement}, 1e-3},
                                   {{kDisplacement, kAcceleration, kAngle}, 1000.0},
                                   {{kDisplacement, kAcceleration, kAngle}, 100.0},
                                   {{kAcceleration, kDisplacement, kAngle}, 1.0 / 9.80665},
                                   {{kAcceleration, kDisplacement, kAngle}, 10.0},
                                   {{kAcceleration, kAngle}, 1.0 / 9.80665},
                                   {{kDeflection, kDisplacement, kAngle}, 1000.0},
                                   {{kStrain}, 1e6},
                                   {{kAngle, kVelocity}, 1000.0}};  // the torque, below
  const std::size_t which = random.below(slips.size());
  const auto run = draw_run(seed, {slips[which].sensors});
  auto result = planted(run, sampled(run, random));
  result.options = known_arm(run, seed);
  const bool is_torque = which + 1 == slips.size();
  auto& channel = channel_of(result.record, slips[which].sensors[0]);
  for (auto& value : is_torque ? result.record.torque_N_m : channel.values) {
    value *= slips[which].factor;
  }
  result.channel = is_torque ? "torque" : arm::to_string(channel.sensor);
  result.description += fmt::format(", {} times {}", result.channel, slips[which].factor);
  return result;
}

/// The least delay, in fine samples: 0.75 periods, 1.5 ms, and what turns the hub (rms) by half the
/// noise of its angle.
int least_delay(DrawnRun& run) {
  const double fine_s = run.fine.time_s[1];
  const double noise_rad = run.noise * deviation(channel_of(run.fine, kAngle).values);
  const double velocity_rad_per_s = deviation(channel_of(run.fine, kVelocity).values);
  const double least_s = std::max(1.5e-3, 0.5 * noise_rad / velocity_rad_per_s);
  return std::max(3, static_cast<int>(std::ceil(least_s / fine_s)));
}

PlantedFault delay(std::uint64_t seed, RandomNumbers& random) {
  if (chance(random, 0.5)) return plant_late_sensor(seed, random);
  constexpr int kRefinement = 4;
  constexpr int kMost = 20;  // five periods
  const auto kind = chance(random, 0.5) ? kAngle : kVelocity;
  DrawnRun run;
  int least = 0;
  do {
    run = draw_run(seed, {{kAngle, kVelocity}, kRefinement, 400, kLeastNoisy});
    least = least_delay(run);
    seed += 10'000;  // another arm
  } while (least > kMost);
  const int late =
      least + static_cast<int>(random.below(static_cast<std::size_t>(kMost + 1 - least)));
  auto result = planted(run, sampled(run, random, kind, late));
  in(result, channel_of(result.record, kind));
  result.description += fmt::format(", {} late by {} periods", result.channel, 0.25 * late);
  return result;
}

PlantedFault zero_torque(std::uint64_t seed, RandomNumbers& random) {
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  const double size = chance(random, 0.5) ? 0.0 : 0.01 * deviation(result.record.torque_N_m);
  for (auto& value : result.record.torque_N_m) value = size == 0.0 ? 0.0 : size * random.normal();
  result.channel = "torque";
  result.description += fmt::format(", torque {}", size);
  return result;
}

}  // namespace

Channel& any_channel(TimeRecord& record, RandomNumbers& random) {
  return record.channels[random.below(record.channels.size())];
}

PlantedFault planted(const DrawnRun& run, TimeRecord record) {
  PlantedFault result;
  result.last_sample = record.time_s.size() - 1;
  result.record = std::move(record);
  result.description = run.description;
  return result;
}

void in(PlantedFault& result, const Channel& channel) {
  result.channel = arm::to_string(channel.sensor);
}

PlantedFault plant(Fault fault, std::uint64_t seed) {
  RandomNumbers random(seed, 2);
  switch (fault) {
    case Fault::clock_jitter:
      return clock_jitter(seed, random);
    case Fault::clock_rate:
      return plant_clock_rate(seed, random);
    case Fault::missing_samples:
      return missing_samples(seed, random);
    case Fault::backward_time:
      return backward_time(seed, random);
    case Fault::saturation:
      return saturation(seed, random);
    case Fault::dead_channel:
      return dead_channel(seed, random);
    case Fault::stuck_values:
      return stuck_values(seed, random);
    case Fault::quantisation:
      return quantisation(seed, random);
    case Fault::spikes:
      return spikes(seed, random);
    case Fault::drift:
      return drift(seed, random);
    case Fault::offset:
      return plant_offset(seed, random);
    case Fault::swapped_channels:
      return swapped_channels(seed, random);
    case Fault::sign_flipped:
      return sign_flipped(seed, random);
    case Fault::wrong_unit:
      return wrong_unit(seed, random);
    case Fault::wrong_scale:
      return plant_wrong_scale(seed, random);
    case Fault::delay:
      return delay(seed, random);
    case Fault::zero_torque:
      return zero_torque(seed, random);
    case Fault::wrong_payload:  // of several runs: run_check_cases.hpp
    case Fault::uneven_noise:
      break;
    case Fault::duplicated_samples:
      return duplicated_samples(seed, random);
    case Fault::hum:
      return hum(seed, random);
    case Fault::sampling_jitter:
      return sampling_jitter(seed, random);
  }
  throw std::logic_error("no such fault");
}

PlantedFault clean(std::uint64_t seed) {
  RandomNumbers random(seed, 2);
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  if (chance(random, 0.75)) result.options = known_arm(run, seed);
  return result;
}

PlantedFault clean_without_noise(std::uint64_t seed) {
  RandomNumbers random(seed, 2);
  auto run = draw_run(seed);
  run.noise = 0.0;
  return planted(run, sampled(run, random));
}

}  // namespace flexarm::measured
