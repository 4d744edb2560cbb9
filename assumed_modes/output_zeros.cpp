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

namespace flexarm::assumed_modes {

namespace {

constexpr std::array kMoreFunctions = {2, 4};

/// Between the first zeros of a beam's strain, and on none of them by accident.
constexpr Real kShiftOfStrain = 37.3L;

bool shows_tip(const arm::Sensor& sensor) {
  return sensor.kind == arm::SensorKind::tip_acceleration ||
         sensor.kind == arm::SensorKind::tip_displacement;
}

/// From this rate on functions are added, in proportion to those there are: 40 are resolved up to
/// twice this rate.
constexpr Real kResolvedRate = 24;

int functions_at(Real rate, int functions) {
  constexpr int kEnough = 40;
  const Real steeper = std::max(Real{0}, rate - kResolvedRate);
  return functions + static_cast<int>(std::ceil(steeper * std::min(functions, kEnough) / kEnough));
}

/// The zero problem in functions times exp(-r xi), factorised at `shift`.
struct Decay {
  Real rate = 0;
  Real shift = 0;

  /// Factorised where solutions of a beam without tension decay as exp(-r xi).
  static Decay with(Real rate) { return {rate, 4 * std::pow(rate, 4)}; }
};

PencilZeros zeros_in(const Decay& decay, const arm::Sensor& sensor, const arm::LinearArm& linear,
                     const ScaledArm& arm, StrainFunctionCount count) {
  const StrainFunctions functions(arm, count);
  const DecayingFunctions trial(functions, arm, decay.rate);
  const Vector output = shows_tip(sensor)
                            ? trial.displacement(1)
                            : trial.curvature(sensor.position_m / Real{linear.length_m});
  return pencil_zeros(decaying_pencil(functions, arm, trial, decay.rate, shows_tip(sensor)), output,
                      decay.shift);
}

}  // namespace

arm::ZeroSet output_zeros(const arm::Sensor& sensor, const arm::LinearArm& arm,
                          const OutputZeroOptions& options, int count) {
  const ScaledArm beyond = beyond_drive(scaled(arm));
  const bool may_decay =
      options.basis == Basis::legendre && sensor.kind != arm::SensorKind::tip_deflection;
  TrustedZeros zeros(options.zero_change);
  bool converged = true;
  const auto add = [&](const PencilZeros& found, const std::array<PencilZeros, 2>& checks) {
    converged = converged && found.converged && checks[0].converged && checks[1].converged;
    zeros.add(checked_roots(found, checks));
  };
  const auto without_decay = [&](int more) {
    const AdmissibleFunctions functions(options.basis, beyond, options.functions, more);
    return pencil_zeros(functions, beyond, output_row(sensor, arm, functions).row,
                        shows_tip(sensor));
  };
  const auto decaying = [&](const Decay& decay, int more) {
    return zeros_in(
        decay, sensor, arm, beyond,
        {.on_whole_beam = functions_at(decay.rate, options.functions) - 1, .more = more});
  };

  const PencilZeros slow = without_decay(0);
  if (may_decay) {
    const Real shift = shows_tip(sensor) ? 0 : kShiftOfStrain;
    add(slow, {decaying({1, shift}, kMoreFunctions[0]), decaying({2, shift}, kMoreFunctions[1])});
  } else {
    add(slow, {without_decay(kMoreFunctions[0]), without_decay(kMoreFunctions[1])});
  }
  constexpr Real kFirstRate = 6;
  constexpr Real kRateStep = 18;
  constexpr Real kLargestRate = 96;
  Real largest_rate = 0;
  for (Real rate = kFirstRate; may_decay && rate <= kLargestRate && !zeros.are_settled(count);
       rate += kRateStep) {
    largest_rate = rate;
    add(decaying(Decay::with(rate), 0), {decaying(Decay::with(rate + 1), kMoreFunctions[0]),
                                         decaying(Decay::with(rate + 2), kMoreFunctions[1])});
  }

  arm::ZeroSet result = zeros.zero_set(count, arm::omega_scale_rad_per_s(arm));
  result.infinite = slow.infinite;
  result.summary.converged = converged;
  result.summary.method = fmt::format(
      "Rosenbrock pencil on {} functions ({}){}; residual: relative change with {} and {} more",
      options.functions, to_string(options.basis),
      largest_rate > 0 ? fmt::format(", and on functions times exp(-r x/l) with r up to {}",
                                     static_cast<double>(largest_rate))
                       : "",
      kMoreFunctions[0], kMoreFunctions[1]);
  return result;
}

}  // namespace flexarm::assumed_modes
