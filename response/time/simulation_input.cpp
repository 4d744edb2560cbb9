#include "response/time/simulation_input.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace flexarm::response {

namespace {

void require_actuator(const Actuator& actuator) {
  using arm::require_in_range;
  require_in_range("effects.time_delay.delay", actuator.delay_s, "s", arm::kNotNegative);
  require_in_range("effects.torque_gain.factor", actuator.gain, "", arm::kAnyFinite);
  require_in_range("effects.torque_dead_zone.width", actuator.dead_zone_N_m, "N m",
                   arm::kNotNegative);
  if (!(actuator.saturation_N_m > 0.0)) {  // infinite: none
    throw arm::out_of_range("effects.torque_saturation.limit", actuator.saturation_N_m, "N m",
                            "a number above 0");
  }
  require_in_range("effects.actuator_lag.time_constant", actuator.lag_s, "s", arm::kNotNegative);
  require_in_range("effects.torque_bias.torque", actuator.bias_N_m, "N m", arm::kAnyFinite);
  if (!actuator.ripple) return;
  require_in_range("effects.torque_ripple.amplitude", actuator.ripple->amplitude_N_m, "N m",
                   arm::kAnyFinite);
  require_in_range("effects.torque_ripple.cycles", actuator.ripple->cycles_per_rev, "1/rev",
                   arm::kAnyFinite);
  require_in_range("effects.torque_ripple.phase", actuator.ripple->phase_rad, "rad",
                   arm::kAnyFinite);
}

void require_friction(const HubFriction& friction) {
  using arm::require_in_range;
  require_in_range("effects.coulomb_friction.torque", friction.coulomb_N_m, "N m",
                   arm::kNotNegative);
  require_in_range("effects.stribeck_friction.torque", friction.stribeck_N_m, "N m",
                   arm::kNotNegative);
  require_in_range("effects.stribeck_friction.static_torque", friction.stribeck_static_N_m, "N m",
                   arm::kNotNegative);
  require_in_range("effects.stribeck_friction.velocity", friction.stribeck_velocity_rad_per_s,
                   "rad/s", arm::kPositive);
}

}  // namespace

void require_simulable(const ArmParts& parts, std::span<const double> torque_N_m,
                       const SimulationOptions& options) {
  using arm::require_in_range;
  require_in_range("sample time", options.sample_time_s, "s", arm::kPositive);
  if (options.substeps < 0 || options.substeps > kMostSubsteps) {
    throw arm::out_of_range("substeps", options.substeps, "",
                            fmt::format("from 0 to {}", kMostSubsteps));
  }
  require_in_range("force tolerance", options.force_tolerance, "", arm::kPositive);
  if (options.most_iterations < 1) {
    throw arm::out_of_range("most iterations", options.most_iterations, "", "1 or more");
  }
  require_actuator(parts.actuator);
  require_friction(parts.friction);
  require_in_range("effects.quadratic_drag.coefficient", parts.quadratic_drag_N_s2_per_m3,
                   "N s^2/m^3", arm::kNotNegative);
  if (parts.sensor_lag) {
    require_in_range("effects.sensor_lag.time_constant", parts.sensor_lag->time_constant_s, "s",
                     arm::kNotNegative);
  }
  if (torque_N_m.empty()) throw arm::InputError("torque: there are no samples");
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) {
    // Half: torques between two samples are formed from their difference.
    constexpr double kLargest = 0.5 * std::numeric_limits<double>::max();
    if (std::abs(parts.actuator.gain * torque_N_m[k]) <= kLargest) continue;
    if (std::isfinite(torque_N_m[k])) {
      throw arm::InputError(
          fmt::format("torque = {} N m at {:.6g} s: too large for a number behind the actuator",
                      torque_N_m[k], static_cast<double>(k) * options.sample_time_s),
          "torque");
    }
    throw arm::InputError(
        fmt::format("torque = {} N m at sample {} (from 0): must be finite", torque_N_m[k], k),
        "torque");
  }
}

}  // namespace flexarm::response
