#pragma once

#include "arm/piecewise_linear.hpp"
#include "arm/sensor.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::arm {

/// The ways in which an effect may act on an arm: a closed set. A formulation, the time stepper or
/// a predictor honours a port or refuses it by name; none of them knows an effect.
enum class Port {
  arm_number,    ///< another number of the arm: rigidity, density, length, ... (struct Arm)
  linear_term,   ///< a term of the linear arm (struct LinearTerms)
  sensor_place,  ///< another place of a strain gauge (struct SensorPlace)
  torque_path,   ///< a stage between the commanded torque and the hub (struct TorqueStage)
  hub_torque,    ///< a law of torque on the hub (HubLaw)
  beam_force,    ///< a force along the beam (struct BeamForce)
  sensor_path,   ///< a stage between a sensor and its reading (struct SensorStage)
};

/// "hub_torque".
std::string_view to_string(Port port);

struct ShearAndRotaryInertia {
  double shear_rigidity_N = 0.0;     ///< k G A
  double rotary_inertia_kg_m = 0.0;  ///< rho I = m thickness^2/12

  bool operator==(const ShearAndRotaryInertia&) const = default;
};

/// A massless rotational spring in the beam: its slope jumps by moment/stiffness there.
struct RotationalSpring {
  double position_m = 0.0;  ///< from the beam's root, 0 or more and below its length
  double stiffness_N_m_per_rad = 0.0;
  /// Its moment is stiffness (1 + retardation d/dt) times the jump; above 0 at the root only.
  double retardation_s = 0.0;

  bool operator==(const RotationalSpring&) const = default;
};

/// What the motor turns the hub through: its rotor, and a rotational spring and a dashpot beside
/// each other between rotor and hub, of moment stiffness (1 + retardation d/dt) times the rotation
/// between them.
struct Drive {
  double rotor_inertia_kg_m2 = 0.0;  ///< a part of the hub's inertia: above 0 and below it
  double stiffness_N_m_per_rad = 0.0;
  double retardation_s = 0.0;

  bool operator==(const Drive&) const = default;
};

/// A spring and a dashpot beside each other, both massless and straight.
struct Suspension {
  double stiffness_N_per_m = 0.0;
  double damping_N_s_per_m = 0.0;

  bool operator==(const Suspension&) const = default;
};

/// A point mass that the beam carries: fixed to its axis, or free to move across it on a
/// suspension, perpendicular to the cross-section's rotation there.
struct MassOnBeam {
  double position_m = 0.0;  ///< from the beam's root, 0 or more and at most its length
  double mass_kg = 0.0;
  std::optional<Suspension> suspension = {};

  bool operator==(const MassOnBeam&) const = default;
};

/// What effects add to the linear arm beyond its numbers; the defaults add nothing. Symbols are
/// those of struct LinearArm.
struct LinearTerms {
  struct Damping {
    double hub_N_m_s_per_rad = 0.0;  ///< c, beside the arm's own
    double kelvin_voigt_s = 0.0;     ///< kv, beside the arm's own
    double air_N_s_per_m2 = 0.0;     ///< ca

    bool operator==(const Damping&) const = default;
  };

  double hub_radius_m = 0.0;            ///< a
  double hub_spring_N_m_per_rad = 0.0;  ///< ks, from the hub's rotor to ground
  std::optional<Drive> drive = {};      ///< between rotor and hub; one at most
  /// In the beam, one at most; those at its root, position 0, are in series between hub and beam.
  std::vector<RotationalSpring> springs = {};
  std::vector<MassOnBeam> masses = {};
  double tip_mass_kg = 0.0;        ///< beside the payload
  double tip_inertia_kg_m2 = 0.0;  ///< about the payload's centre of mass, beside its own
  double payload_offset_m = 0.0;   ///< of the payload's centre of mass beyond the tip
  double gravity_m_per_s2 = 0.0;   ///< g, along the arm from the hub to the tip
  /// What a Timoshenko beam has besides EI and m.
  std::optional<ShearAndRotaryInertia> shear = {};
  Damping damping = {};

  bool operator==(const LinearTerms&) const = default;
};

/// First-order lag, 1/(1 + time_constant s).
struct Lag {
  double time_constant_s = 0.0;

  bool operator==(const Lag&) const = default;
};

struct Delay {
  double delay_s = 0.0;

  bool operator==(const Delay&) const = default;
};

/// One stage of the torque's path. Stages follow each other by `order`, from the command to the
/// hub.
struct TorqueStage {
  int order = 0;
  std::variant<Delay, PiecewiseLinear, Lag> what;

  bool operator==(const TorqueStage&) const = default;
};

/// Places in the torque's path; a stage between two of them has a number between.
namespace torque_order {
inline constexpr int kDelay = 10;
inline constexpr int kGain = 20;
inline constexpr int kDeadZone = 30;
inline constexpr int kSaturation = 40;
inline constexpr int kLag = 50;
}  // namespace torque_order

/// The hub at one instant, as a law of torque on it may depend on it.
struct HubState {
  double angle_rad = 0.0;
  double velocity_rad_per_s = 0.0;
  double torque_N_m = 0.0;  ///< of the actuator, behind the torque's path
  double time_s = 0.0;      ///< since the first sample
};

/// Torque on the hub, which is smooth in the hub's state, with states of its own where it has any:
/// z' = rate(hub, z), z = 0 at the first sample.
struct SmoothHubTorque {
  struct Value {
    double torque_N_m = 0.0;
    double per_velocity_N_m_s = 0.0;  ///< d torque/d velocity
  };
  /// z has `states` entries, and as many rates are to be written.
  std::function<Value(const HubState& hub, std::span<const double> z, std::span<double> rates)> law;
  int states = 0;
  bool depends_on_time = false;
  /// Of states that move with the angle alone, however fast, and are of the order of 1: writes what
  /// z is after the hub has turned by that angle, one way, to `after`. Empty for other laws.
  std::function<void(double turn_rad, std::span<const double> z, std::span<double> after)>
      after_turn = {};
};

/// A torque on the hub that never changes.
struct ConstantHubTorque {
  double torque_N_m = 0.0;
};

/// Dry friction: torque of size F against the motion. At rest it is whatever holds the hub, up to F
/// of speed 0.
struct DryFriction {
  struct Size {
    double torque_N_m = 0.0;       ///< F, 0 or more
    double per_speed_N_m_s = 0.0;  ///< dF/d speed
  };
  std::function<Size(double speed_rad_per_s)> size;  ///< for a speed of 0 or more
  /// The scale of speed over which F changes; empty: F is the same at every speed.
  std::optional<double> changes_over_rad_per_s = {};
};

/// A smooth torque and dry friction beside it.
struct HubTorqueWithFriction {
  SmoothHubTorque smooth;
  DryFriction friction;
};

using HubLaw = std::variant<ConstantHubTorque, SmoothHubTorque, DryFriction, HubTorqueWithFriction>;

/// Force per length on the beam by its velocity there, an odd function that takes energy:
/// force(v) v <= 0.
struct BeamForce {
  /// force_N_per_m[i] += force(velocity_m_per_s[i]); both have the same number of entries.
  std::function<void(std::span<const double> velocity_m_per_s, std::span<double> force_N_per_m)>
      add;
};

/// The gauge `strain@X` sits at X + shift.
struct SensorPlace {
  Sensor sensor;
  double shift_m = 0.0;

  bool operator==(const SensorPlace&) const = default;
};

/// The reading is factor times the value.
struct Gain {
  double factor = 1.0;

  bool operator==(const Gain&) const = default;
};

/// A constant that is added to the reading.
struct Offset {
  double value = 0.0;  ///< in the sensor's unit

  bool operator==(const Offset&) const = default;
};

/// One stage of what a sensor's value passes before it is a reading. Stages of one sensor follow
/// each other in the order of the alternatives.
struct SensorStage {
  Sensor sensor;
  std::variant<Gain, Delay, Lag, Offset> what;

  bool operator==(const SensorStage&) const = default;
};

}  // namespace flexarm::arm
