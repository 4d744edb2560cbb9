#include "measured/data_check_response.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

/// Mean coherence squared of a channel and its nearest relative below which it has none.
/// Unrelated channels show 1/8 or so.
constexpr double kRelated = 0.4;
/// Variance over floor of the spectrum; 1 for white noise but for the scatter of the floor.
constexpr double kWhite = 4.0;

/// Accelerations and strains are compared with hub and tip motion after as many derivatives as make
/// their spectra alike.
Quantity whitened(const Comparison& comparison, std::size_t i) {
  const auto& signal = comparison.signals[i];
  return {i, signal.is(SensorKind::hub_angle) || signal.is(SensorKind::tip_displacement) ? 1 : 0};
}

double relation(const Comparison& comparison, std::size_t i, std::size_t j) {
  const auto a = whitened(comparison, i);
  const auto b = whitened(comparison, j);
  return std::max(mean_coherence(comparison.transforms, a, b).value,
                  mean_coherence(comparison.transforms, b, a).value);
}

bool is_white(const Comparison& comparison, std::size_t i) {
  const double deviation = comparison.signals[i].deviation;
  return deviation * deviation < kWhite * comparison.transforms.of[i].floor_power;
}

}  // namespace

std::vector<DataFinding> check_response(const Comparison& comparison) {
  const std::size_t count = comparison.signals.size();
  std::vector<double> closest(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      if (!comparison.usable[i] || !comparison.usable[j]) continue;
      const double found = relation(comparison, i, j);
      closest[i] = std::max(closest[i], found);
      closest[j] = std::max(closest[j], found);
    }
  }
  const bool torque_is_noise =
      comparison.usable[0] && closest[0] < kRelated && is_white(comparison, 0);
  std::vector<DataFinding> findings;
  if (torque_is_noise) {
    findings.push_back({Fault::zero_torque, "torque", 0, 0.0, comparison.signals[0].deviation,
                        fmt::format("torque is noise of {:.3g} N m that no sensor answers: nothing "
                                    "says what moves the arm",
                                    comparison.signals[0].deviation)});
  }
  for (std::size_t i = 1; i < count; ++i) {
    const bool alone = count == 2;
    if (!comparison.usable[i] || closest[i] >= kRelated || (alone && torque_is_noise)) continue;
    findings.push_back(
        {Fault::dead_channel, comparison.signals[i].name, 0, 0.0, closest[i],
         fmt::format("{} is unrelated to the torque and to every other channel: mean coherence "
                     "squared {:.2g} at most",
                     comparison.signals[i].name, closest[i])});
  }
  return findings;
}

}  // namespace flexarm::measured
