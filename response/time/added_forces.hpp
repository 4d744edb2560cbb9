#pragma once

#include "response/time/beam_forces.hpp"
#include "response/time/modal_dynamics.hpp"

#include <Eigen/Core>

#include <optional>
#include <string_view>
#include <vector>

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

/// The state of an arm at an instant, with the torque of its actuator.
struct ArmInstant {
  const Eigen::VectorXd& x;  ///< LinearSystem's X
  double actuator_N_m = 0.0;
  double time_s = 0.0;
};

/// What acts on the arm beside the actuator's torque: laws of torque on the hub, forces along the
/// beam. For each HubMotion a smooth function of the state, continued beyond the motion's end.
class AddedForces {
 public:
  struct HubTorque {
    double torque_N_m = 0.0;
    double per_velocity_N_m_s = 0.0;  ///< d torque/d theta'
    std::vector<double> rates = {};   ///< of the laws' own states
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
  /// Laws without dry friction.
  HubTorque smooth_torque(const ArmInstant& now) const;
  /// Laws and dry friction.
  HubTorque hub_torque(const ArmInstant& now, HubMotion motion) const;
  /// f for what acts on the hub at that instant: with it the forces along the beam and the rates of
  /// the laws' own states.
  Eigen::VectorXd force(const ArmInstant& now, const HubTorque& hub) const;
  /// The effect for which the hub is watched or forces are iterated, in inner steps; empty where
  /// the equations are linear.
  std::string_view effect_in_steps() const;
  double friction_power_W(double hub_velocity_rad_per_s) const;
  double beam_power_W(const Eigen::VectorXd& x) const;

 private:
  arm::HubState hub_state(const ArmInstant& now) const;

  const ModalDynamics* arm_;
  HubLaws hub_;
  std::optional<BeamForces> beam_;
  double friction_scale_rad_per_s_;
  double breakaway_N_m_;
  bool vary_;
};

/// Those of an arm's parts; `model` is the one that `arm` was made of.
AddedForces added_forces(const ModalDynamics& arm, const arm::ModalModel& model,
                         const ArmParts& parts);

}  // namespace flexarm::response
