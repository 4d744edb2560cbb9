#pragma once

#include "arm/arm.hpp"
#include "arm/ports.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::response {

/// What the commanded torque passes before it acts on the hub: the delay, the functions without
/// memory one after the other, the lag. The defaults change nothing.
struct Actuator {
  double delay_s = 0.0;
  std::vector<arm::PiecewiseLinear> maps = {};
  double lag_s = 0.0;

  /// The command behind the maps.
  double mapped(double command_N_m) const {
    for (const auto& map : maps) command_N_m = map(command_N_m);
    return command_N_m;
  }
  /// The commands at which that bends, ascending.
  std::vector<double> bends() const;
  /// The product of the gains among the maps. Maps that are not proportional are left out.
  double gain() const;

  bool operator==(const Actuator&) const = default;
};

/// What the value of a sensor passes before it is a reading: the factor, the delay, the lag; then
/// the offset is added. The defaults change nothing.
struct SensorChain {
  arm::Sensor sensor;
  double gain = 1.0;
  double delay_s = 0.0;
  double lag_s = 0.0;
  double offset = 0.0;  ///< in the sensor's unit

  bool operator==(const SensorChain&) const = default;
};

/// The sensor's of `chains`, or one that changes nothing.
SensorChain chain_of(std::span<const SensorChain> chains, const arm::Sensor& sensor);

/// Something that an effect does through a port, with the effect's name.
template <class Part>
struct OfEffect {
  std::string effect;
  Part part;
};

/// Torque on the hub beside the actuator's. Dry friction of several effects adds up.
struct HubLaws {
  double constant_N_m = 0.0;
  std::vector<OfEffect<arm::SmoothHubTorque>> smooth = {};
  std::vector<OfEffect<arm::DryFriction>> friction = {};

  /// Size of all dry friction at a speed of 0 or more, and its change with the speed.
  arm::DryFriction::Size friction_at(double speed_rad_per_s) const;
  /// The least scale of speed over which friction changes; infinite where it does not.
  double friction_scale_rad_per_s() const;
};

/// A torque on the hub that nobody recorded, as a stationary first-order Gauss-Markov process: its
/// autocorrelation falls as e^(-|t|/T). With T = 0 it is white: another one at each sample of a
/// filter, held to the next, as the error of a recorded torque is.
struct HubDisturbance {
  double correlation_time_s = 0.0;  ///< T, 0 or more

  bool is_white() const { return correlation_time_s == 0.0; }
};

/// An arm taken apart by who honours its effects: a formulation those of the linear arm, response/
/// the others.
struct ArmParts {
  /// The arm with its effects on the linear arm alone; of an effect that acts elsewhere too, that
  /// part.
  arm::Arm linear;
  Actuator actuator = {};
  HubLaws hub = {};
  std::vector<OfEffect<arm::BeamForce>> beam_forces = {};
  std::vector<SensorChain> sensor_chains = {};  ///< one a sensor at most, each of some stage
  /// A state of the time model that a Kalman filter moves; 0 without one.
  std::optional<HubDisturbance> disturbance = {};
  /// The hub turns as it is told (with_driven_hub): the command is its angular acceleration in
  /// rad/s^2, in the place of a torque.
  bool hub_is_driven = false;
};

/// Adds what an effect does through ports outside of the linear arm; a stage of the torque's path
/// behind those that are there. Throws InputError as `take_apart`.
void add_effect(ArmParts& parts, const arm::Effect& effect);

/// Throws InputError for an invalid arm, and by the name of effect and port for a path of the
/// torque or of a sensor that is not modelled: two lags, or a map that is not proportional behind a
/// lag.
ArmParts take_apart(const arm::Arm& arm);

/// The arm of `parts` with a hub whose motion is given: what acts on the hub alone, its inertia,
/// spring, friction and laws, and the path of the torque, has no influence and is left out. The
/// hub's inertia is then `kDrivenHubInertia` times that of the arm, which the modes depend on, and
/// the motion does not: the modes are nearly those of the arm with its hub clamped, and few
/// suffice. Throws InputError for an arm without a beam.
ArmParts with_driven_hub(ArmParts parts);
inline constexpr double kDrivenHubInertia = 1e4;

/// Names of the arm's effects that poles, zeros and frequency responses leave out because they are
/// not linear: maps of the torque that are not proportional, laws of hub torque, forces along the
/// beam. (A constant torque shifts the working point only.) In the order of their names.
std::vector<std::string> nonlinear_effects(const arm::Arm& arm);

/// Those of them that are there with their slopes at rest, as terms of the linear arm.
std::vector<std::string> linearised_effects(const arm::Arm& arm);

}  // namespace flexarm::response
