#include "measured/checks/data_check_drift.hpp"

#include "measured/checks/data_check_coefficient.hpp"
#include "measured/spectra/robust.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

constexpr int kHighestLine = 4;
constexpr std::size_t kEndShare = 10;  // of the samples, the first and the last tenth

struct Trend {
  double size = 0.0;  ///< from start to end, in the unit of the signal
  double error = 0.0;
};

std::optional<std::size_t> find(std::span<const CheckedSignal> signals,
                                const std::vector<bool>& usable, SensorKind kind) {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (usable[i] && signals[i].is(kind)) return i;
  }
  return std::nullopt;
}

/// hub_angle less the integral of hub_velocity by the trapezoidal rule. White noise of deviation n
/// in the velocity walks by n period sqrt(samples).
Trend trend_of_angle(const CheckedSignal& angle, const CheckedSignal& velocity, double angle_noise,
                     double velocity_noise, double period_s) {
  const std::size_t samples = angle.values.size();
  const std::size_t part = std::max<std::size_t>(1, samples / kEndShare);
  double integral = 0.0;
  double start = 0.0;
  double end = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0) integral += 0.5 * period_s * (velocity.values[k] + velocity.values[k - 1]);
    const double left = angle.values[k] - integral;
    if (k < part) start += left / static_cast<double>(part);
    if (k + part >= samples) end += left / static_cast<double>(part);
  }
  const double walk = velocity_noise * period_s * std::sqrt(static_cast<double>(samples));
  return {end - start, std::hypot(walk, angle_noise * std::sqrt(2.0 / static_cast<double>(part)))};
}

/// Lines 0 to kHighestLine of values under Hann's window: real parts, then imaginary ones.
Eigen::VectorXd slow_lines(std::span<const double> values) {
  Eigen::VectorXd lines = Eigen::VectorXd::Zero(2 * kHighestLine + 1);
  const double step = 2.0 * std::numbers::pi / static_cast<double>(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double phase = step * (static_cast<double>(k) + 0.5);
    const double weighted = (1.0 - std::cos(phase)) * values[k];
    lines[0] += weighted;
    for (int j = 1; j <= kHighestLine; ++j) {
      lines[j] += weighted * std::cos(j * phase);
      lines[kHighestLine + j] += weighted * std::sin(j * phase);
    }
  }
  return lines / static_cast<double>(values.size());
}

Trend trend_beside_torque(const CheckedSignal& signal, const CheckedSignal& torque) {
  const std::size_t samples = signal.values.size();
  std::vector<double> one(samples, 1.0);
  std::vector<double> ramp(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    ramp[k] = (static_cast<double>(k) + 0.5) / static_cast<double>(samples) - 0.5;
  }
  const Eigen::VectorXd lines = slow_lines(signal.values);
  Eigen::MatrixXd columns(lines.size(), 3);
  columns.col(0) = slow_lines(ramp);
  columns.col(1) = slow_lines(one);
  columns.col(2) = slow_lines(torque.values);
  if (torque.deviation > 0.0) columns.col(2) /= torque.deviation;
  const auto [size, error] = coefficient_of(0, std::move(columns), lines);
  return {size, error};
}

std::optional<DataFinding> drift_finding(const CheckedSignal& signal, const Trend& trend,
                                         const char* beside, const DataCheckOptions& options) {
  // Not finite: of readings near the largest double.
  const double size = std::abs(trend.size);
  const bool is_drift =
      size > options.least_drift * signal.deviation && size > options.drift_errors * trend.error;
  if (!is_drift || !std::isfinite(size)) return std::nullopt;
  return DataFinding{Fault::drift,
                     signal.name,
                     0,
                     0.0,
                     trend.size,
                     fmt::format("{} drifts by {:.4g} {} over the record relative to {} ({:.2g} of "
                                 "its standard deviation)",
                                 signal.name, trend.size, arm::unit(*signal.sensor), beside,
                                 size / signal.deviation)};
}

}  // namespace

std::vector<DataFinding> check_trends(std::span<const CheckedSignal> signals,
                                      const std::vector<bool>& usable,
                                      const DataCheckOptions& options) {
  std::vector<DataFinding> findings;
  for (std::size_t i = 1; i < signals.size(); ++i) {
    const bool integrates_nothing = signals[i].is(SensorKind::tip_acceleration) ||
                                    signals[i].is(SensorKind::tip_deflection) ||
                                    signals[i].is(SensorKind::strain);
    if (!usable[i] || !integrates_nothing) continue;
    const auto finding = drift_finding(signals[i], trend_beside_torque(signals[i], signals[0]),
                                       "the torque", options);
    if (finding) findings.push_back(*finding);
  }
  return findings;
}

std::vector<DataFinding> check_angle_drift(std::span<const CheckedSignal> signals,
                                           const std::vector<bool>& usable,
                                           std::span<const double> floor_power, double period_s,
                                           const DataCheckOptions& options) {
  const auto angle = find(signals, usable, SensorKind::hub_angle);
  const auto velocity = find(signals, usable, SensorKind::hub_velocity);
  if (!angle || !velocity) return {};
  const Trend trend =
      trend_of_angle(signals[*angle], signals[*velocity], std::sqrt(floor_power[*angle]),
                     std::sqrt(floor_power[*velocity]), period_s);
  const auto finding =
      drift_finding(signals[*angle], trend, "the integral of hub_velocity", options);
  return finding ? std::vector{*finding} : std::vector<DataFinding>{};
}

}  // namespace flexarm::measured
