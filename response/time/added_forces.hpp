#pragma once

#include "response/time/drag.hpp"
#include "response/time/modal_dynamics.hpp"

#include <Eigen/Core>

#include <optional>
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

/// What acts on the arm beside the actuator's torque: bias, ripple and dry friction on the hub,
/// drag on the beam. For each HubMotion a smooth function of the state, continued beyond the
/// motion's end.
class AddedForces {
 public:
  struct HubTorque {
    double torque_N_m = 0.0;
    double per_velocity_N_m_s = 0.0;  ///< d torque/d theta'
  };

  /// `arm` must outlive the object.
  AddedForces(const ModalDynamics& arm, const ArmParts& parts, std::optional<QuadraticDrag> drag);

  /// False: constant for each motion.
  bool vary() const { return vary_; }
  /// Friction depends on speed, on the scale of `falling_velocity_rad_per_s`.
  bool friction_falls() const { return friction_.stribeck_N_m != friction_.stribeck_static_N_m; }
  double falling_velocity_rad_per_s() const { return friction_.stribeck_velocity_rad_per_s; }
  double breakaway_N_m() const { return friction_.breakaway_N_m(); }
  /// Bias and ripple.
  double offset_N_m(double hub_angle_rad) const;
  /// Bias, ripple and friction.
  HubTorque hub_torque(const Eigen::VectorXd& x, HubMotion motion) const;
  /// f for that torque, and the drag at the state.
  Eigen::VectorXd force(const Eigen::VectorXd& x, double hub_torque_N_m) const;
  /// The effect for which the hub is watched or forces are iterated, in inner steps; empty where
  /// the equations are linear.
  std::string_view effect_in_steps() const;
  double friction_power_W(double hub_velocity_rad_per_s) const;
  double drag_power_W(const Eigen::VectorXd& x) const;

 private:
  const ModalDynamics* arm_;
  HubFriction friction_;
  double bias_N_m_;
  std::optional<TorqueRipple> ripple_;
  std::optional<QuadraticDrag> drag_;
  bool vary_;
};

}  // namespace flexarm::response
