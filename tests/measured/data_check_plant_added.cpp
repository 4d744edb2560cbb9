#include "tests/measured/data_check_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

namespace flexarm::measured {

using response::RandomNumbers;

namespace {

/// Amplitude of the line of a signal at a frequency, rms of those beside it: what a line of hum
/// must exceed.
double amplitude_beside(const std::vector<double>& values, double period_s, double frequency_Hz) {
  const auto samples = static_cast<double>(values.size());
  double power = 0.0;
  int lines = 0;
  for (int side = 2; side <= 12; ++side) {
    for (const int line : {-side, side}) {
      const double omega = 2.0 * std::numbers::pi * (frequency_Hz * period_s + line / samples);
      std::complex<double> sum;
      for (std::size_t k = 0; k < values.size(); ++k) {
        const double at = static_cast<double>(k);
        const double window = 1.0 - std::cos(2.0 * std::numbers::pi * (at + 0.5) / samples);
        sum += window * values[k] * std::polar(2.0 / samples, -omega * at);
      }
      power += std::norm(sum);
      ++lines;
    }
  }
  return std::sqrt(power / lines);
}

/// Single samples of the torque that the arm knows nothing of.
PlantedFault torque_spikes(PlantedFault result, RandomNumbers& random) {
  auto& torque = result.record.torque_N_m;
  const double size = deviation(torque);
  const std::size_t count = 1 + random.below(6);
  result.first_sample = torque.size();
  result.last_sample = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = 10 + random.below(torque.size() - 20);
    const double spike = (chance(random, 0.5) ? 1.0 : -1.0) * log_between(random, 0.8, 10.0);
    torque[at] += size * spike;
    result.first_sample = std::min(result.first_sample, at);
    result.last_sample = std::max(result.last_sample, at);
    result.description += fmt::format(", spike of {:.2g} at {}", spike, at + 1);
  }
  result.channel = "torque";
  return result;
}

}  // namespace

PlantedFault hum(std::uint64_t seed, RandomNumbers& random) {
  constexpr double kDetectable = 16.0;  // standard deviations of a line of noise
  constexpr double kBeside = 3.0;       // lines beside it
  while (true) {
    const auto run = draw_run(seed);
    auto result = planted(run, sampled(run, random));
    auto& record = result.record;
    const double period_s = record.time_s[1] - record.time_s[0];
    const double mains_Hz = chance(random, 0.5) ? 50.0 : 60.0;
    const double frequency_Hz = mains_Hz + between(random, -0.05, 0.05);
    // Of a torque that is made of lines one more tells nothing.
    const bool has_lines = run.description.find("multisine") != std::string::npos ||
                           run.description.find("bang-bang") != std::string::npos;
    const bool in_torque = chance(random, 0.3) && !has_lines;
    auto& channel = any_channel(record, random);
    if (in_torque) {
      result.channel = "torque";
    } else {
      in(result, channel);
    }
    auto& values = in_torque ? record.torque_N_m : channel.values;
    const double size = deviation(values);
    const double noise = 2.0 * run.noise / std::sqrt(static_cast<double>(values.size()));
    const double beside = amplitude_beside(values, period_s, frequency_Hz) / size;
    const double least = std::max({0.05, kDetectable * noise, kBeside * beside});
    seed += 10'000;  // another run
    if (least > 1.0) continue;
    const double amplitude = size * log_between(random, least, 1.0);
    const double phase = between(random, 0.0, 2.0 * std::numbers::pi);
    add_line(values, period_s, frequency_Hz, amplitude, phase);
    result.description += fmt::format(", hum of {:.2f} Hz in {}, {:.3f} deviations", frequency_Hz,
                                      result.channel, amplitude / size);
    return result;
  }
}

PlantedFault spikes(std::uint64_t seed, RandomNumbers& random) {
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  if (chance(random, 0.3)) return torque_spikes(std::move(result), random);
  auto& channel = any_channel(result.record, random);
  in(result, channel);
  const double size = deviation(channel.values);
  const bool many = chance(random, 0.4);
  const double share = many ? log_between(random, 0.01, 0.045) : 0.0;
  const std::size_t count =
      many ? static_cast<std::size_t>(share * static_cast<double>(channel.values.size()))
           : 1 + random.below(6);
  constexpr double kFound = 0.9;  // of many
  if (many) result.least_readings = static_cast<std::size_t>(kFound * static_cast<double>(count));
  result.first_sample = channel.values.size();
  result.last_sample = 0;
  std::set<std::size_t> places;
  while (places.size() < count) {
    const std::size_t at = 5 + random.below(channel.values.size() - 10);
    if (!places.insert(at).second) continue;
    const double spike = (chance(random, 0.5) ? 1.0 : -1.0) *
                         (many ? between(random, 2.0, 4.0) : log_between(random, 0.8, 10.0));
    channel.values[at] += size * spike;
    if (!many) result.description += fmt::format(", spike of {:.2g} at {}", spike, at + 1);
    result.first_sample = std::min(result.first_sample, at);
    result.last_sample = std::max(result.last_sample, at);
  }
  result.description +=
      fmt::format(", {} spikes of {} samples in {}", count, channel.values.size(), result.channel);
  return result;
}

}  // namespace flexarm::measured
