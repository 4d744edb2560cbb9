#include "measured/checks/data_check_delay.hpp"

#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

/// Cosine of the phase that the delay leaves, by the described arm: where it leaves more, the arm
/// is not as described.
constexpr double kDescribedAgreement = 0.97;
constexpr std::size_t kFewestLagBlocks = 3;

/// Signal a is `delay_s` later than signal b.
struct Lag {
  std::size_t a = 0;
  std::size_t b = 0;
  double delay_s = 0.0;
  double error_s = 0.0;  ///< standard error
  double least_s = 0.0;  ///< what counts as a delay

  bool is_one(double delay) const { return std::abs(delay) > least_s; }
};

std::vector<Lag> lags_of(const Comparison& comparison) {
  const auto& options = comparison.options;
  const double period_s = comparison.transforms.period_s;
  std::vector<Lag> lags;
  const auto add = [&](std::size_t a, std::size_t b, const GainFit& fit, double least_periods) {
    lags.push_back({a, b, fit.delay_s, fit.delay_error_s,
                    std::max(least_periods * period_s, options.delay_errors * fit.delay_error_s)});
  };
  const auto angle = comparison.find(SensorKind::hub_angle);
  const auto velocity = comparison.find(SensorKind::hub_velocity);
  if (angle && velocity) {
    const GainFit fit = fit_gain(comparison.transforms, {*velocity, 0}, {*angle, 1});
    if (holds(fit)) add(*velocity, *angle, fit, options.least_delay_periods);
  }
  for (const auto& [a, b, fit] : comparison.described_and_held()) {
    const bool is_told =
        angle && velocity && (a == *velocity || b == *velocity) && (a == *angle || b == *angle);
    const bool is_clear =
        fit.sign > 0 && fit.blocks >= kFewestLagBlocks && fit.agreement >= kDescribedAgreement;
    if (b != 0 && !is_told && is_clear) add(a, b, fit, options.least_described_delay_periods);
  }
  return lags;
}

/// A sensor that would be late by all its lags.
struct LateSensor {
  std::size_t signal = 0;
  double delay_s = 0.0;
  double error_s = 0.0;
  std::size_t other = 0;  ///< the one that tells most narrowly
  bool is_one = true;     ///< by each of its lags
  std::size_t lags = 0;
  std::size_t unexplained = 0;  ///< delays that are there all the same
};

std::optional<LateSensor> late(const std::vector<Lag>& lags, std::size_t signal) {
  LateSensor sensor{.signal = signal};
  std::vector<double> delays;
  for (const Lag& lag : lags) {
    if (lag.a != signal && lag.b != signal) continue;
    delays.push_back(lag.a == signal ? lag.delay_s : -lag.delay_s);
    sensor.is_one = sensor.is_one && lag.is_one(lag.delay_s);
    if (delays.size() > 1 && lag.error_s >= sensor.error_s) continue;
    sensor.error_s = lag.error_s;
    sensor.other = lag.a == signal ? lag.b : lag.a;
  }
  sensor.lags = delays.size();
  sensor.delay_s = median(std::move(delays));
  if (!(sensor.delay_s > 0.0)) return std::nullopt;
  for (const Lag& lag : lags) {
    double delay_s = lag.delay_s;
    if (lag.a == signal) delay_s -= sensor.delay_s;
    if (lag.b == signal) delay_s += sensor.delay_s;
    if (lag.is_one(delay_s)) ++sensor.unexplained;
  }
  return sensor;
}

}  // namespace

std::vector<DataFinding> check_delay(const Comparison& comparison) {
  const auto lags = lags_of(comparison);
  // Of three sensors two that agree tell which one is late.
  const auto sensors = std::count(comparison.usable.begin() + 1, comparison.usable.end(), true);
  const std::size_t least_lags = sensors > 2 && !comparison.described.empty() ? 2 : 1;
  std::optional<LateSensor> found;
  for (std::size_t i = 1; i < comparison.signals.size() && !found; ++i) {
    const auto sensor = late(lags, i);
    const bool is_late =
        sensor && sensor->is_one && sensor->lags >= least_lags && sensor->unexplained == 0;
    if (is_late) found = sensor;
  }
  if (!found) return {};
  const std::string& name = comparison.signals[found->signal].name;
  return {{Fault::delay, name, 0, 0.0, found->delay_s,
           fmt::format("{} is delayed by {:.3g} s relative to {} (standard error {:.1g} s, {:.2f} "
                       "sampling periods)",
                       name, found->delay_s, comparison.signals[found->other].name, found->error_s,
                       found->delay_s / comparison.transforms.period_s)}};
}

}  // namespace flexarm::measured
