#include "assumed_modes/output_zeros.hpp"

#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/decaying_functions.hpp"
#include "assumed_modes/output_row.hpp"
#include "assumed_modes/pencil_zeros.hpp"
#include "assumed_modes/scaled_arm.hpp"
#include "assumed_modes/trusted_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

namespace flexarm::assumed_modes {

namespace {

constexpr std::array kMoreFunctions = {2, 4};

/// Mean rates of decay.
constexpr Real kFirstRate = 6;
constexpr Real kRateStep = 18;
constexpr Real kLargestRate = 96;

/// Between the first zeros of a beam's strain, and on none of them by accident.
constexpr Real kShiftOfStrain = 37.3L;

bool shows_tip(const arm::Sensor& sensor) {
  return sensor.kind == arm::SensorKind::tip_acceleration ||
         sensor.kind == arm::SensorKind::tip_displacement;
}

/// Solutions times exp(r xi) are as steep as exp(2 r xi): functions that resolve them.
int needed_functions(Real mean_rate) {
  constexpr int kWithoutDecay = 16;
  return kWithoutDecay + static_cast<int>(std::ceil(mean_rate));
}

/// Whether functions of a mean rate of decay leave digits of a root: its condition number is
/// exp(|kappa - rate|). What is beyond this is a root of other equations, and may change little all
/// the same: a suspended mass swings at its own frequency on whatever beam rounding has left.
bool has_digits(const ScaledArm& arm, std::complex<Real> root, Real rate, double zero_change) {
  const Real condition = std::exp(std::abs(mean_decay(arm, root) - rate));
  return condition * std::numeric_limits<Real>::epsilon() <= zero_change;
}

/// A model with this many functions or more is given those that a rate needs. A coarser one stays
/// as it is, and goes without the rates that it does not resolve.
constexpr int kFine = 28;

}  // namespace

arm::ZeroSet output_zeros(const arm::Sensor& sensor, const arm::LinearArm& arm,
                          const OutputZeroOptions& options, int count) {
  const ScaledArm beyond = beyond_drive(scaled(arm));
  const bool may_decay =
      options.basis == Basis::legendre && sensor.kind != arm::SensorKind::tip_deflection;
  TrustedZeros zeros(options.zero_change);
  bool converged = true;
  const auto add = [&](const PencilZeros& found, const std::array<PencilZeros, 2>& checks,
                       Real rate) {
    converged = converged && found.converged && checks[0].converged && checks[1].converged;
    auto roots = checked_roots(found, checks);
    if (rate > 0) {
      std::erase_if(roots, [&](const CheckedRoot& root) {
        return !has_digits(beyond, root.s, rate, options.zero_change);
      });
    }
    zeros.add(roots);
  };
  const auto without_decay = [&](int more) {
    const AdmissibleFunctions functions(options.basis, beyond, options.functions, more);
    return pencil_zeros(functions, beyond, output_row(sensor, arm, functions).row,
                        shows_tip(sensor));
  };
  const std::optional<Real> strain_at =
      shows_tip(sensor) ? std::nullopt : std::optional(sensor.position_m / Real{arm.length_m});
  const auto decaying = [&](Real mean_rate, int more) {
    const Decay decay = decay_of(beyond, mean_rate);
    const StrainFunctions functions(
        beyond, {.on_whole_beam = std::max(options.functions, needed_functions(mean_rate)) - 1,
                 .more = more});
    const Real shift =
        mean_rate < kFirstRate ? strain_at ? kShiftOfStrain : 0 : decay.sigma_squared;
    return pencil_zeros(decaying_pencil(functions, beyond, decay, strain_at), shift);
  };
  // Checks have other rates, so that their rounding is another.
  const auto checks_of = [&](Real mean_rate) {
    return std::array{decaying(mean_rate + 1, kMoreFunctions[0]),
                      decaying(mean_rate + 2, kMoreFunctions[1])};
  };

  const PencilZeros slow = without_decay(0);
  add(slow,
      may_decay ? checks_of(0)
                : std::array{without_decay(kMoreFunctions[0]), without_decay(kMoreFunctions[1])},
      0);
  const Real resolved = options.functions - needed_functions(0);
  const Real largest_allowed =
      options.functions >= kFine ? kLargestRate : std::min(kLargestRate, resolved);
  Real largest_rate = 0;
  for (Real rate = kFirstRate; may_decay && rate <= largest_allowed && !zeros.are_settled(count);
       rate += kRateStep) {
    largest_rate = rate;
    add(decaying(rate, 0), checks_of(rate), rate);
  }

  arm::ZeroSet result = zeros.zero_set(count, arm::omega_scale_rad_per_s(arm));
  result.infinite = slow.infinite;
  result.summary.converged = converged;
  result.summary.method = fmt::format(
      "Rosenbrock pencil on {} functions ({}){}; residual: relative change with {} and {} more",
      options.functions, to_string(options.basis),
      largest_rate > 0 ? fmt::format(", and on functions that decay with mean rates up to {}",
                                     static_cast<double>(largest_rate))
                       : "",
      kMoreFunctions[0], kMoreFunctions[1]);
  return result;
}

}  // namespace flexarm::assumed_modes
