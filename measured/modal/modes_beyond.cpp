#include "measured/modal/modes_beyond.hpp"

#include "measured/modal/fitted_transfer.hpp"

#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

namespace flexarm::measured {

namespace {

using Eigen::Index;

/// Blocks damped by more stand for several modes, or for none.
constexpr double kMostDampingRatio = 0.7;

std::vector<std::size_t> blocks_in(const BlockSet& set, const FitBand& band) {
  std::vector<std::size_t> found;
  for (std::size_t m = set.rigid ? 1 : 0; m < set.blocks.size(); ++m) {
    const double frequency_Hz = set.blocks[m].omega_rad_per_s() / (2.0 * std::numbers::pi);
    if (band.contains(frequency_Hz) && set.blocks[m].damping_ratio() <= kMostDampingRatio) {
      found.push_back(m);
    }
  }
  return found;
}

/// Power of omega that b0 of displacement grows with, from the hub slopes of a beam whose root
/// turns freely, phi' ~ omega^(1/2): with phi' twice at the hub, with phi of one size at the tip.
/// Strain's phi'' grows with omega besides, but hub inertia holds phi' back.
double growth(arm::SensorKind kind) {
  switch (kind) {
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_deflection:
      return 0.5;
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
    case arm::SensorKind::strain:
      return 1.0;
  }
  return 1.0;
}

/// Root mean square of b0/omega^growth.
double size_without_growth(const BlockFit& fit, std::size_t sensor,
                           const std::vector<std::size_t>& blocks) {
  const FittedTransfer transfer(fit.blocks, fit.models[sensor],
                                fit.sensors[sensor].beta.head(fit.models[sensor].shared));
  double squares = 0.0;
  for (const std::size_t m : blocks) {
    const double size = transfer.numerator(m).b0 / std::pow(fit.blocks.blocks[m].omega_rad_per_s(),
                                                            growth(fit.models[sensor].sensor.kind));
    squares += size * size;
  }
  return std::sqrt(squares / static_cast<double>(blocks.size()));
}

}  // namespace

ModesBeyond with_modes_beyond(const BlockFit& fit, const ColumnChoices& choices,
                              const FitBand& band) {
  ModesBeyond beyond{fit.blocks, choices};
  const auto known = blocks_in(fit.blocks, band);
  if (known.empty()) return beyond;
  beyond.blocks.held = std::size(kHeldAt);
  for (const double at : kHeldAt) {
    beyond.blocks.blocks.push_back(
        block_of(2.0 * std::numbers::pi * at * band.to_Hz, kHeldDamping * at));
  }
  const auto sensors = static_cast<Index>(fit.sensors.size());
  beyond.choices.held_tightness.resize(sensors, static_cast<Index>(beyond.blocks.held));
  for (Index j = 0; j < sensors; ++j) {
    const auto sensor = static_cast<std::size_t>(j);
    const double size = size_without_growth(fit, sensor, known);
    for (std::size_t h = 0; h < beyond.blocks.held; ++h) {
      const double deviation =
          size * std::pow(beyond.blocks.blocks[fit.blocks.blocks.size() + h].omega_rad_per_s(),
                          growth(fit.models[sensor].sensor.kind));
      beyond.choices.held_tightness(j, static_cast<Index>(h)) =
          std::sqrt(fit.sensors[sensor].variance) / deviation;
    }
  }
  return beyond;
}

}  // namespace flexarm::measured
