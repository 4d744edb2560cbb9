#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::response {

/// torque amplitude sin(cycles theta + phase), added at the hub.
struct TorqueRipple {
  double amplitude_N_m = 0.0;
  double cycles_per_rev = 1.0;  ///< multiplies theta [rad] as docs/formats.md has it
  double phase_rad = 0.0;

  bool operator==(const TorqueRipple&) const = default;
};

/// What the commanded torque passes before it acts on the hub, in this order: delay, gain, dead
/// zone, saturation, lag; then bias and ripple are added. The defaults change nothing.
struct Actuator {
  double delay_s = 0.0;
  double gain = 1.0;
  double dead_zone_N_m = 0.0;
  double saturation_N_m = std::numeric_limits<double>::infinity();
  double lag_s = 0.0;
  double bias_N_m = 0.0;
  std::optional<TorqueRipple> ripple;

  bool operator==(const Actuator&) const = default;
};

/// Dry friction on the hub against its motion, of the size
///
///     coulomb + stribeck + (stribeck_static - stribeck) exp(-(theta'/velocity)^2),
///
/// which at rest holds the hub against any torque up to its value at theta' = 0. Coulomb and
/// Stribeck friction of an arm that has both add up.
struct HubFriction {
  double coulomb_N_m = 0.0;
  double stribeck_N_m = 0.0;
  double stribeck_static_N_m = 0.0;
  double stribeck_velocity_rad_per_s = 1.0;

  bool is_zero() const;
  double torque_N_m(double hub_velocity_rad_per_s) const;  ///< size at that speed, 0 or more
  double breakaway_N_m() const;                            ///< size at rest

  bool operator==(const HubFriction&) const = default;
};

/// A sensor's reading passes 1/(1 + time_constant s).
struct SensorLag {
  arm::Sensor sensor;
  double time_constant_s = 0.0;

  bool operator==(const SensorLag&) const = default;
};

/// An arm taken apart by who honours its effects: a formulation the linear ones, response/ the
/// others.
struct ArmParts {
  arm::Arm linear;  ///< the arm with its linear effects alone
  Actuator actuator;
  HubFriction friction;
  double quadratic_drag_N_s2_per_m3 = 0.0;  ///< force per length -coefficient |v| v on the beam
  std::optional<SensorLag> sensor_lag;
};

/// Throws InputError for an invalid arm.
ArmParts take_apart(const arm::Arm& arm);

/// Names of the arm's effects that poles, zeros and frequency responses leave out because they are
/// not linear: friction, drag, ripple, dead zone, saturation. (A bias shifts the working point
/// only.) In the vocabulary's order.
std::vector<std::string> nonlinear_effects(const arm::Arm& arm);

}  // namespace flexarm::response
