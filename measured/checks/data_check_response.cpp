#include "measured/checks/data_check_response.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

/// Mean coherence squared of a channel and its nearest relative below which it has none.
/// Unrelated channels show 1/8 or so.
constexpr double kRelated = 0.3;
constexpr std::size_t kFewestCoherentBlocks = 3;
/// Variance over floor of the spectrum; 1 for white noise but for the scatter of the floor.
constexpr double kWhite = 4.0;

/// Time derivatives of a displacement that a signal shows at low frequencies, where what bends the
/// arm is its acceleration.
int order_of(const CheckedSignal& signal) {
  if (signal.is_torque() || signal.is(SensorKind::tip_deflection) ||
      signal.is(SensorKind::strain)) {
    return 2;
  }
  return arm::derivative_order(*signal.sensor);
}

/// Two signals as derivatives of alike spectra: where one falls across a block and the other does
/// not, coherence is lost.
struct AlikePair {
  Quantity x;
  Quantity y;
};

AlikePair alike(const Comparison& comparison, std::size_t i, std::size_t j) {
  const int a = order_of(comparison.signals[i]);
  const int b = order_of(comparison.signals[j]);
  const int order = std::max(a, b);
  return {{i, order - a}, {j, order - b}};
}

/// How much of signal i is related to signal j.
double relation(const Comparison& comparison, std::size_t i, std::size_t j) {
  const auto [x, y] = alike(comparison, i, j);
  return mean_coherence(comparison.transforms, x, y);
}

/// Whether a few blocks of signal i are coherent with another, as those where the torque drives it.
/// The power of an angle is in its slowest lines, which friction and the end of the record disturb.
bool answers_somewhere(const Comparison& comparison, std::size_t i) {
  for (std::size_t j = 0; j < comparison.signals.size(); ++j) {
    if (i == j || !comparison.usable[j]) continue;
    const auto [x, y] = alike(comparison, i, j);
    if (coherent_blocks(comparison.transforms, x, y) >= kFewestCoherentBlocks) return true;
  }
  return false;
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
    for (std::size_t j = 0; j < count; ++j) {
      if (i == j || !comparison.usable[i] || !comparison.usable[j]) continue;
      closest[i] = std::max(closest[i], relation(comparison, i, j));
    }
  }
  const bool torque_is_noise =
      comparison.usable[0] && closest[0] < kRelated && is_white(comparison, 0);
  std::vector<DataFinding> findings;
  if (torque_is_noise) {
    findings.push_back({Fault::zero_torque, "torque", 0, 0.0, comparison.signals[0].deviation,
                        fmt::format("torque is noise of {:.3g} N m without coherence with any "
                                    "sensor: the actual input is unknown",
                                    comparison.signals[0].deviation)});
  }
  // An arm at rest moves no sensor. One sensor alone has only the torque to answer, from which
  // friction and a record of few blocks may part it; it is dead if it is noise besides.
  const auto others_respond = [&](std::size_t self) {
    if (count == 2) return comparison.usable[0] && !torque_is_noise && is_white(comparison, self);
    for (std::size_t i = 1; i < count; ++i) {
      if (i != self && closest[i] >= kRelated) return true;
    }
    return false;
  };
  for (std::size_t i = 1; i < count; ++i) {
    if (!comparison.usable[i] || closest[i] >= kRelated || !others_respond(i)) continue;
    if (answers_somewhere(comparison, i)) continue;
    findings.push_back(
        {Fault::dead_channel, comparison.signals[i].name, 0, 0.0, closest[i],
         fmt::format(
             "{}: no coherence with torque or any other channel (mean gamma^2 at most {:.2g})",
             comparison.signals[i].name, closest[i])});
  }
  return findings;
}

}  // namespace flexarm::measured
