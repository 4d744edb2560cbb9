#pragma once

#include "response/time/beam_forces.hpp"
#include "response/time/modal_dynamics.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace flexarm::response {

/// Which way the hub turns: dry friction is smooth for each.
enum class HubMotion {
  frictionless,  ///< no dry friction: whichever
  held,
  forward,
  backward
};

/// +1 forward, -1 backward, else 0.
inline double direction(HubMotion motion) {
  return motion == HubMotion::forward ? 1.0 : motion == HubMotion::backward ? -1.0 : 0.0;
}

/// The vector's entries, where they are.
inline std::span<double> entries(Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}
inline std::span<const double> entries(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

/// What forces are functions of at an instant.
struct ForceInstant {
  std::span<const double> arguments;  ///< AddedForces::form_arguments of the state
  double actuator_N_m = 0.0;
  double time_s = 0.0;
};

/// The state of an arm, and what AddedForces computes of it once for all that needs it.
struct ArmState {
  Eigen::VectorXd x;           ///< LinearSystem's X, N
  Eigen::VectorXd arguments;   ///< AddedForces::form_arguments
  Eigen::VectorXd along_beam;  ///< modal forces [1/s^2], n; empty without forces along the beam
};

/// What acts on the arm beside the actuator's torque: laws of torque on the hub, forces along the
/// beam. For each HubMotion a smooth function of the state, continued beyond the motion's end.
///
/// Forces depend on the state X by their arguments alone, a few linear combinations of it, in this
/// order: angle [rad] and velocity [rad/s] of the hub; the lagged torque [N m], 0 without a lag;
/// the states of laws; with forces along the beam the n modal velocities [1/s]. Forces that are
/// constant for each HubMotion have no arguments.
class AddedForces {
 public:
  struct HubTorque {
    double torque_N_m = 0.0;
    double per_velocity_N_m_s = 0.0;  ///< d torque/d theta'
  };

  /// `arm` must outlive the object.
  AddedForces(const ModalDynamics& arm, const HubLaws& hub, std::optional<BeamForces> beam);

  bool has_friction() const { return !hub_.friction.empty(); }
  /// False: constant for each motion.
  bool vary() const { return vary_; }
  /// The scale of speed over which friction changes; infinite where it does not.
  double friction_scale_rad_per_s() const { return friction_scale_rad_per_s_; }
  double breakaway_N_m() const { return breakaway_N_m_; }
  /// Size of dry friction at a speed of 0 or more.
  arm::DryFriction::Size friction_at(double speed_rad_per_s) const {
    return hub_.friction_at(speed_rad_per_s);
  }

  /// Writes the arguments at the state X = x to `arguments`.
  void form_arguments(const Eigen::VectorXd& x, Eigen::VectorXd& arguments) const;
  /// The matrix that X is multiplied by for the arguments: a row an argument, N columns.
  Eigen::MatrixXd argument_rows() const;
  /// The hub's velocity [rad/s], one of the arguments; there must be any.
  static double hub_velocity(std::span<const double> arguments) { return arguments[kVelocity]; }

  /// Laws have states, and all of these move with the hub's angle alone (after_turn).
  bool states_move_by_turn() const { return states_move_by_turn_; }
  /// Writes the states of laws after the hub has turned, one way, from where it has the arguments
  /// `from`, to the angle that `arguments` has, to `arguments`.
  void turn_states(std::span<const double> from, std::span<double> arguments) const;
  /// The states of laws among the arguments.
  auto law_states(std::span<const double> arguments) const {
    return arguments.subspan(kLawStates, static_cast<std::size_t>(arm_->law_state_count));
  }

  /// Writes `arguments` and `along_beam` of the state.
  void update(ArmState& state) const;
  /// Writes the modal forces along the beam [1/s^2] to `made`: n entries. Does nothing without such
  /// forces.
  void form_along_beam(std::span<const double> arguments, Eigen::VectorXd& made) const;
  /// Writes LinearSystem's f to `made`, m entries, `along_beam` being what form_along_beam gives
  /// for these arguments. Returns the torque on the hub in it.
  HubTorque form(const ForceInstant& now, HubMotion motion, const Eigen::VectorXd& along_beam,
                 Eigen::VectorXd& made) const;
  bool has_smooth_laws() const { return !hub_.smooth.empty(); }
  /// Returns the torque on the hub at these arguments; `rates` is written to.
  double hub_torque_N_m(const ForceInstant& now, HubMotion motion, Eigen::VectorXd& rates) const;
  /// Torque on the hub without dry friction.
  double smooth_torque_N_m(const Eigen::VectorXd& x, double actuator_N_m, double time_s) const;

  /// The effect for which the hub is watched or forces are iterated, in inner steps; empty where
  /// the equations are linear.
  std::string_view effect_in_steps() const;
  double friction_power_W(double hub_velocity_rad_per_s) const;
  double beam_power_W(const Eigen::VectorXd& x) const;

 private:
  static constexpr std::size_t kAngle = 0;
  static constexpr std::size_t kVelocity = 1;
  static constexpr std::size_t kLaggedTorque = 2;
  static constexpr std::size_t kLawStates = 3;  // the first of them

  Eigen::Index argument_count() const;
  // Both write the rates of the laws' states to `rates`.
  HubTorque smooth_torque(const ForceInstant& now, std::span<double> rates) const;
  HubTorque hub_torque(const ForceInstant& now, HubMotion motion, std::span<double> rates) const;

  const ModalDynamics* arm_;
  HubLaws hub_;
  std::optional<BeamForces> beam_;
  double friction_scale_rad_per_s_;
  double breakaway_N_m_;
  bool vary_;
  bool states_move_by_turn_;
};

/// Those of an arm's parts; `model` is the one that `arm` was made of.
AddedForces added_forces(const ModalDynamics& arm, const arm::ModalModel& model,
                         const ArmParts& parts);

}  // namespace flexarm::response
