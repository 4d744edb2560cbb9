#include "measured/checks/data_check_shaking.hpp"

#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

using Eigen::Index;

std::vector<Index> torque_jumps(const Eigen::VectorXd& torque) {
  constexpr double kJump = 0.5;
  constexpr double kUnusual = 8.0;
  constexpr Index kBeside = 12;
  const Eigen::VectorXd change =
      (torque.tail(torque.size() - 1) - torque.head(torque.size() - 1)).cwiseAbs();
  const double usual = median({change.data(), change.data() + change.size()});
  std::vector<Index> jumps;
  for (Index k = 0; k < change.size(); ++k) {
    if (change[k] <= std::max(kJump, kUnusual * usual)) continue;
    const Index from = std::max<Index>(0, k - kBeside);
    const Index to = std::min(change.size(), k + kBeside + 1);
    if (change[k] > kUnusual * median({change.data() + from, change.data() + to})) {
      jumps.push_back(k);
    }
  }
  return jumps;
}

namespace {

/// Marks `reach` samples on either side of where the hub's mean velocity over `window` samples
/// begins or ends to exceed its noise, or turns. An angle has it by differences.
void mark_stops(const CheckedSignal& hub, std::size_t window, std::size_t reach,
                std::vector<bool>& shaken) {
  constexpr double kNoises = 4.0;
  constexpr double kLeastMotion = 0.03;  // standard deviations
  const bool is_angle = hub.is(arm::SensorKind::hub_angle);
  const std::size_t samples = shaken.size();
  std::vector<double> motion;
  for (std::size_t k = 0; k + window < samples; ++k) {
    motion.push_back(is_angle ? hub.values[k + window] - hub.values[k]
                              : mean(hub.values.subspan(k, window)));
  }
  const double noise = reading_noise(hub.values) *
                       (is_angle ? std::sqrt(2.0) : 1.0 / std::sqrt(static_cast<double>(window)));
  const double rest = std::max(kNoises * noise, kLeastMotion * standard_deviation(motion));
  const auto state = [&](double value) { return value > rest ? 1 : (value < -rest ? -1 : 0); };
  for (std::size_t k = 1; k < motion.size(); ++k) {
    if (state(motion[k]) == state(motion[k - 1])) continue;
    const std::size_t from = k > reach ? k - reach : 0;
    const std::size_t to = std::min(samples, k + window + reach);
    std::fill(shaken.begin() + static_cast<std::ptrdiff_t>(from),
              shaken.begin() + static_cast<std::ptrdiff_t>(to), true);
  }
}

}  // namespace

std::vector<bool> samples_near_stops(std::span<const CheckedSignal> signals,
                                     const std::vector<bool>& usable, std::size_t reach) {
  constexpr std::size_t kWindow = 5;
  constexpr std::size_t kShortStop = 2;  // seen in a velocity alone
  std::vector<bool> shaken(signals[0].values.size(), false);
  const CheckedSignal* hub = hub_signal(signals, usable);
  if (hub == nullptr) return shaken;
  mark_stops(*hub, kWindow, reach, shaken);
  if (!hub->is(arm::SensorKind::hub_angle)) mark_stops(*hub, kShortStop, reach, shaken);
  return shaken;
}

std::vector<bool> none_if_many(std::vector<bool> shaken) {
  constexpr double kMany = 0.25;
  const auto count = static_cast<double>(std::ranges::count(shaken, true));
  if (count > kMany * static_cast<double>(shaken.size())) shaken.assign(shaken.size(), false);
  return shaken;
}

}  // namespace flexarm::measured
