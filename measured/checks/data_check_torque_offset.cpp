#include "measured/checks/data_check_torque_offset.hpp"

#include "measured/checks/data_check_coefficient.hpp"
#include "measured/spectra/robust.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

constexpr double kHighest_Hz = 2.0;
constexpr double kFewestLines = 16.0;
/// Half of the time over which an angle is differenced.
constexpr double kHalfStep_s = 0.01;

/// The hub's velocity at the samples, from its own sensor or by central differences of the angle.
std::vector<double> velocity_of(const CheckedSignal& hub, double period_s) {
  const std::size_t count = hub.values.size();
  if (hub.is(SensorKind::hub_velocity)) return {hub.values.begin(), hub.values.end()};
  const auto reach = std::max<std::size_t>(1, static_cast<std::size_t>(kHalfStep_s / period_s));
  std::vector<double> velocity(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from = k > reach ? k - reach : 0;
    const std::size_t to = std::min(count - 1, k + reach);
    velocity[k] = (hub.values[to] - hub.values[from]) / (static_cast<double>(to - from) * period_s);
  }
  return velocity;
}

/// -1 to 1, smooth over velocities that are next to rest.
std::vector<double> directions(const std::vector<double>& velocity) {
  constexpr double kRest = 0.05;  // of its standard deviation
  const double rest = kRest * standard_deviation(velocity);
  std::vector<double> sign;
  for (const double value : velocity) sign.push_back(std::tanh(value / std::max(rest, 1e-300)));
  return sign;
}

/// Velocities over which friction fades, of the standard deviation: the first is for the estimate,
/// the others show what it owes to this choice.
constexpr std::array<double, 3> kFades = {0.3, 0.1, 1.0};
/// Most by which these estimates may differ, of the first.
constexpr double kMostApart = 0.5;

/// Friction that is more near rest, as Stribeck's: a direction that fades with the velocity.
std::vector<double> near_rest(const std::vector<double>& direction,
                              const std::vector<double>& velocity, double fades_over) {
  const double fades = std::max(fades_over * standard_deviation(velocity), 1e-300);
  std::vector<double> friction;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    friction.push_back(direction[k] * std::exp(-std::abs(velocity[k]) / fades));
  }
  return friction;
}

/// Real parts, then imaginary ones, of the hub's acceleration over the lines that are asked.
Eigen::VectorXd slow_acceleration(const CheckedSignal& hub, std::span<const double> values,
                                  double period_s) {
  CheckedSignal signal = hub;
  signal.values = values;
  signal.deviation = standard_deviation(values);
  const Transforms transforms = transform(std::span(&signal, 1), period_s, true);
  const int order = 2 - arm::derivative_order(*hub.sensor);
  const double to_Hz = std::max(kHighest_Hz, kFewestLines / transforms.duration_s);
  // The window tells half a line from the mean.
  const auto first = static_cast<std::size_t>(std::ceil(0.5 * transforms.bins_per_line));
  const auto last = transforms.bin_at(to_Hz);
  const auto count = static_cast<Eigen::Index>(last - first + 1);
  Eigen::VectorXd lines(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto value = transforms.derivative(0, order, first + static_cast<std::size_t>(i));
    lines[i] = value.real();
    lines[count + i] = value.imag();
  }
  return lines / std::sqrt(transforms.bins_per_line);
}

}  // namespace

std::vector<DataFinding> check_torque_offset(const Comparison& comparison,
                                             const DescribedArm& arm) {
  const CheckedSignal* measured = hub_signal(comparison.signals, comparison.usable);
  if (measured == nullptr || !comparison.usable[0]) return {};
  const CheckedSignal& hub = *measured;
  const CheckedSignal& torque = comparison.signals[0];
  const double period_s = comparison.transforms.period_s;
  const auto answer = [&](std::span<const double> torque_N_m) {
    return slow_acceleration(hub, arm(torque_N_m, period_s, std::span(&*hub.sensor, 1)).front(),
                             period_s);
  };
  const std::vector<double> velocity = velocity_of(hub, period_s);
  const Eigen::VectorXd target = slow_acceleration(hub, hub.values, period_s);
  const std::vector<double> direction = directions(velocity);
  Eigen::MatrixXd columns(target.size(), 5);
  columns.col(0) = answer(torque.values);
  columns.col(1) = -answer(std::vector<double>(hub.values.size(), 1.0));
  columns.col(2) = -answer(direction);
  columns.col(3) = -answer(velocity);
  std::vector<Coefficient> offsets;
  for (const double fades_over : kFades) {
    columns.col(4) = -answer(near_rest(direction, velocity, fades_over));
    offsets.push_back(coefficient_of(1, columns, target));
  }
  const auto [offset, error] = offsets.front();
  const double size = std::abs(offset);
  const auto [least, most] = std::ranges::minmax(offsets, {}, &Coefficient::value);
  if (!(size > comparison.options.least_torque_offset * torque.deviation) ||
      !(size > comparison.options.offset_errors * error) ||
      most.value - least.value > kMostApart * size) {
    return {};
  }
  return {
      {Fault::offset, torque.name, 0, 0.0, offset,
       fmt::format("torque has an offset of {:.4g} N m by the motion of the hub (standard error "
                   "{:.1g} N m, {:.2g} of its standard deviation), or a constant torque is "
                   "not recorded",
                   offset, error, size / torque.deviation)}};
}

}  // namespace flexarm::measured
