#include "measured/data_check_kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

constexpr double kFlat = 0.1;         // log10 of a gain that is one for all frequencies
constexpr double kAgreement = 0.9;    // cosine of the phase that a sign and a delay leave
constexpr double kUnity = 0.1;        // log10 of a gain of 1
constexpr double kNoDelay_periods = 1.5;
// An exchange is claimed where it makes the identity hold more narrowly than chance would.
constexpr double kExact = 0.05;  // log10
constexpr std::size_t kFewestBlocks = 2;

/// The signal that stands in the column of `at` when columns a and b are exchanged.
std::size_t exchanged(std::size_t at, std::size_t a, std::size_t b) {
  if (at == a) return b;
  return at == b ? a : at;
}

GainFit fit_of(const Comparison& comparison, const Identity& identity, std::size_t a,
               std::size_t b) {
  return fit_gain(comparison.transforms,
                  {exchanged(identity.x.signal, a, b), identity.x.order},
                  {exchanged(identity.y.signal, a, b), identity.y.order});
}

bool is_identity(const Comparison& comparison, const GainFit& fit) {
  return holds(fit) && std::abs(fit.log10_gain) <= kUnity && fit.sign > 0 &&
         std::abs(fit.delay_s) <= kNoDelay_periods * comparison.transforms.period_s;
}

DataFinding swap_finding(const Comparison& comparison, std::size_t a, std::size_t b,
                         const std::string& why) {
  const auto& first = comparison.signals[a].name;
  const auto& second = comparison.signals[b].name;
  return {Fault::swapped_channels, first, 0, 0.0, 0.0,
          fmt::format("{} and {} are exchanged: {}", first, second, why)};
}

/// Whether an exchange makes the two less plausible than they are.
bool is_stranger(const Comparison& comparison, std::size_t a, std::size_t b) {
  const auto& first = comparison.signals[a];
  const auto& second = comparison.signals[b];
  return implausibility(first, second.deviation) + implausibility(second, first.deviation) >
         implausibility(first, first.deviation) + implausibility(second, second.deviation);
}

std::optional<DataFinding> implausible_pair(const Comparison& comparison) {
  const auto& signals = comparison.signals;
  for (std::size_t a = 1; a < signals.size(); ++a) {
    for (std::size_t b = a + 1; b < signals.size(); ++b) {
      if (!comparison.usable[a] || !comparison.usable[b]) continue;
      if (implausibility(signals[a], signals[a].deviation) == 0.0 ||
          implausibility(signals[b], signals[b].deviation) == 0.0 ||
          implausibility(signals[a], signals[b].deviation) > 0.0 ||
          implausibility(signals[b], signals[a].deviation) > 0.0) {
        continue;
      }
      return swap_finding(comparison, a, b,
                          fmt::format("standard deviations of {:.3g} {} and {:.3g} {} are each out "
                                      "of reach, and not the other way round",
                                      signals[a].deviation, arm::unit(*signals[a].sensor),
                                      signals[b].deviation, arm::unit(*signals[b].sensor)));
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> Comparison::find(SensorKind kind) const {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (usable[i] && signals[i].is(kind)) return i;
  }
  return std::nullopt;
}

std::vector<Identity> identities_of(const Comparison& comparison) {
  std::vector<Identity> identities;
  const auto angle = comparison.find(SensorKind::hub_angle);
  const auto velocity = comparison.find(SensorKind::hub_velocity);
  const auto displacement = comparison.find(SensorKind::tip_displacement);
  const auto acceleration = comparison.find(SensorKind::tip_acceleration);
  if (angle && velocity) identities.push_back({{*velocity, 0}, {*angle, 1}});
  if (displacement && acceleration) identities.push_back({{*acceleration, 0}, {*displacement, 2}});
  return identities;
}

bool holds(const GainFit& fit) {
  return fit.blocks >= 1 && fit.spread <= kFlat && fit.agreement >= kAgreement;
}

double rigid_band_Hz(const Transforms& transforms) {
  constexpr double kRigid_Hz = 0.4;
  constexpr double kLines = 1.25;
  return std::max(kRigid_Hz, kLines / transforms.duration_s);
}

bool shows_rigid_motion(const Transforms& transforms) {
  constexpr double kHighest_Hz = 0.65;
  return rigid_band_Hz(transforms) <= kHighest_Hz;
}

std::string unit_slip(double log10_factor) {
  struct Slip {
    const char* meaning;
    double factor;
  };
  constexpr double kPi = std::numbers::pi;
  constexpr Slip kSlips[] = {{"degrees for radians", 180.0 / kPi},
                             {"radians for degrees", kPi / 180.0},
                             {"rev/min for rad/s", 30.0 / kPi},
                             {"turns for radians", 0.5 / kPi}};
  constexpr double kNear = 0.08;  // log10: 20 %
  const double power = std::round(log10_factor);
  // 9.81 and 9.55 are told from 10 by nothing but the least noise.
  if (power != 0.0 && std::abs(log10_factor - power) <= kNear) {
    return fmt::format("a factor of 1e{:.0f}{}", power,
                       std::abs(power) == 1.0 ? ", or g for m/s^2" : "");
  }
  for (const auto& [meaning, factor] : kSlips) {
    if (std::abs(log10_factor - std::log10(factor)) <= kNear) return meaning;
  }
  return "";
}

double implausibility(const Signal& signal, double deviation) {
  struct Reach {
    double least;
    double most;
  };
  Reach reach{1e-5, 1e3};  // torque
  if (signal.is(SensorKind::hub_angle)) reach = {1e-5, 30.0};
  if (signal.is(SensorKind::hub_velocity)) reach = {1e-4, 100.0};
  if (signal.is(SensorKind::tip_acceleration)) reach = {2e-2, 1e4};
  if (signal.is(SensorKind::tip_displacement)) reach = {1e-5, 30.0};
  if (signal.is(SensorKind::tip_deflection)) reach = {1e-6, 1.0};
  if (signal.is(SensorKind::strain)) reach = {1e-9, 1e-2};
  if (deviation <= 0.0) return 0.0;
  return std::max({0.0, std::log10(deviation / reach.most), std::log10(reach.least / deviation)});
}

std::vector<DataFinding> check_swaps(const Comparison& comparison) {
  const auto identities = identities_of(comparison);
  bool all_hold = true;
  for (const auto& identity : identities) {
    const GainFit fit = fit_gain(comparison.transforms, identity.x, identity.y);
    all_hold = all_hold && holds(fit) &&
               (std::abs(fit.log10_gain) <= kUnity || !unit_slip(fit.log10_gain).empty());
  }
  std::optional<DataFinding> found;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t count = all_hold ? 0 : comparison.signals.size();
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      if (!comparison.usable[a] || !comparison.usable[b] || is_stranger(comparison, a, b)) continue;
      double misfit = 0.0;
      bool restored = true;
      for (const auto& identity : identities) {
        const GainFit fit = fit_of(comparison, identity, a, b);
        restored = restored && is_identity(comparison, fit) && fit.blocks >= kFewestBlocks &&
                   fit.spread <= kExact && std::abs(fit.log10_gain) <= kExact;
        misfit += fit.spread + std::abs(fit.log10_gain) + (1.0 - fit.agreement);
      }
      if (!restored || misfit >= least) continue;
      least = misfit;
      found = swap_finding(comparison, a, b,
                           "the other way round one is the derivative of the other, as it must be");
    }
  }
  if (!found) found = implausible_pair(comparison);
  return found ? std::vector{*found} : std::vector<DataFinding>{};
}

std::vector<DataFinding> check_delay(const Comparison& comparison) {
  const auto angle = comparison.find(SensorKind::hub_angle);
  const auto velocity = comparison.find(SensorKind::hub_velocity);
  if (!angle || !velocity) return {};
  const GainFit fit = fit_gain(comparison.transforms, {*velocity, 0}, {*angle, 1});
  const double period_s = comparison.transforms.period_s;
  if (!holds(fit) ||
      std::abs(fit.delay_s) <= comparison.options.least_delay_periods * period_s ||
      std::abs(fit.delay_s) <= comparison.options.delay_errors * fit.delay_error_s) {
    return {};
  }
  const auto& late = comparison.signals[fit.delay_s > 0.0 ? *velocity : *angle];
  const auto& other = comparison.signals[fit.delay_s > 0.0 ? *angle : *velocity];
  return {{Fault::delay, late.name, 0, 0.0, std::abs(fit.delay_s),
           fmt::format("{} is {:.3g} s later than {} (standard error {:.1g} s): {:.2f} sampling "
                       "periods",
                       late.name, std::abs(fit.delay_s), other.name, fit.delay_error_s,
                       std::abs(fit.delay_s) / period_s)}};
}

}  // namespace flexarm::measured
