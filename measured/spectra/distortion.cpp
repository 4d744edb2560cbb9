#include "measured/spectra/distortion.hpp"

#include "measured/spectra/tail_probability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::measured {

namespace {

/// Lines are numbered from 1, vectors from 0.
std::size_t number_of(std::size_t index) {
  return index + 1;
}

bool is_odd(std::size_t index) {
  return number_of(index) % 2 == 1;
}

/// The indices to test, by parity.
struct TestLines {
  std::vector<std::size_t> odd;
  std::vector<std::size_t> even;
};

std::vector<std::size_t> free_lines(const std::vector<bool>& driven, bool odd, std::size_t last) {
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k <= last; ++k) {
    if (!driven[k] && is_odd(k) == odd) lines.push_back(k);
  }
  return lines;
}

TestLines test_lines(const std::vector<bool>& driven, std::size_t highest) {
  constexpr std::size_t kEnoughLines = 4;
  TestLines lines{free_lines(driven, true, highest), free_lines(driven, false, highest)};
  if (lines.odd.size() < kEnoughLines) {
    const std::size_t below_nyquist = driven.size() * 9 / 10;
    const std::size_t last = std::min(3 * number_of(highest), std::max(below_nyquist, highest)) - 1;
    lines.odd = free_lines(driven, true, std::max(last, highest));
  }
  return lines;
}

/// Smallest and joint probability of independent ones that noise alone makes uniform.
double joint_probability(const std::vector<double>& probabilities) {
  if (probabilities.empty()) return 1.0;
  const auto count = static_cast<double>(probabilities.size());
  double sum = 0.0;
  for (const double p : probabilities) {
    sum -= std::log(std::max(p, std::numeric_limits<double>::min()));
  }
  // Fisher: -2 sum log p is chi^2 with 2 n degrees of freedom.
  const double fisher = chi_squared_tail(2.0 * sum, 2.0 * count);
  const double smallest = -std::expm1(
      count * std::log1p(-std::min(1.0 - 1e-16, *std::ranges::min_element(probabilities))));
  return std::min(1.0, 2.0 * std::min(fisher, smallest));
}

double in_dB(double power_ratio) {
  return power_ratio > 0.0 ? 10.0 * std::log10(power_ratio)
                           : -std::numeric_limits<double>::infinity();
}

/// Mean square amplitude of the driven lines from `first` to `last`, or of all where none is there.
double driven_power(const PeriodicSignal& output, const std::vector<bool>& driven,
                    std::size_t first, std::size_t last) {
  double inside = 0.0;
  double all = 0.0;
  std::size_t count_inside = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < driven.size(); ++k) {
    if (!driven[k]) continue;
    const double power = std::norm(output.amplitude[k]);
    all += power;
    ++count;
    if (k < first || k > last) continue;
    inside += power;
    ++count_inside;
  }
  return count_inside > 0 ? inside / static_cast<double>(count_inside)
                          : all / static_cast<double>(count);
}

DistortionTest test(const PeriodicSignal& output, const std::vector<bool>& driven,
                    const std::vector<std::size_t>& lines, double freedom, double level) {
  DistortionTest made;
  made.lines = lines.size();
  if (lines.empty()) {
    made.level_dB = made.noise_dB = -std::numeric_limits<double>::infinity();
    return made;
  }
  std::vector<double> probabilities;
  double power = 0.0;
  double noise = 0.0;
  for (const std::size_t k : lines) {
    probabilities.push_back(probability_of_chance(output, k, freedom));
    power += std::norm(output.amplitude[k]);
    noise += output.noise_std[k] * output.noise_std[k];
  }
  made.probability = joint_probability(probabilities);
  made.found = made.probability < level;
  const double reference =
      driven_power(output, driven, lines.front(), lines.back()) * static_cast<double>(lines.size());
  made.level_dB = in_dB(std::max(0.0, power - noise) / reference);
  made.noise_dB = in_dB(noise / reference);
  return made;
}

}  // namespace

Distortion distortion(const PeriodicSpectra& spectra, const DistortionSettings& settings) {
  Distortion made;
  const auto driven = driven_lines(spectra);
  const auto last = std::find(driven.rbegin(), driven.rend(), true);
  if (last == driven.rend()) {
    made.reason = "the torque has no spectral line";
    return made;
  }
  for (std::size_t k = 0; k < driven.size(); ++k) {
    if (!driven[k] || is_odd(k)) continue;
    made.reason = fmt::format(
        "the torque excites even lines (e.g. {:.4g} Hz): odd and even distortion cannot be "
        "separated; use an odd multisine",
        spectra.frequency_Hz[k]);
    return made;
  }
  if (spectra.periods < 2) {
    made.reason =
        "one period only: noise and distortion cannot be separated; record several periods";
    return made;
  }
  const auto highest = static_cast<std::size_t>(driven.rend() - last) - 1;
  const TestLines lines = test_lines(driven, highest);
  made.testable = true;
  made.reason = fmt::format(
      "{} odd and {} even detection lines, tested against the variation between {} periods",
      lines.odd.size(), lines.even.size(), spectra.periods);
  const double level =
      settings.false_alarm_rate / (2.0 * static_cast<double>(spectra.outputs.size()));
  for (const auto& output : spectra.outputs) {
    ChannelDistortion& channel = made.channels.emplace_back();
    for (std::size_t k = 0; k < driven.size(); ++k) {
      channel.lines.push_back(
          {spectra.frequency_Hz[k],
           driven[k] ? LineKind::driven : (is_odd(k) ? LineKind::odd : LineKind::even),
           std::abs(output.amplitude[k]), output.noise_std[k],
           driven[k] ? 1.0 : probability_of_chance(output, k, spectra.degrees_of_freedom)});
    }
    channel.odd = test(output, driven, lines.odd, spectra.degrees_of_freedom, level);
    channel.even = test(output, driven, lines.even, spectra.degrees_of_freedom, level);
  }
  return made;
}

}  // namespace flexarm::measured
