#include "response/time/added_forces.hpp"

#include <cmath>
#include <utility>

namespace flexarm::response {

AddedForces::AddedForces(const ModalDynamics& arm, const ArmParts& parts,
                         std::optional<QuadraticDrag> drag)
    : arm_(&arm),
      friction_(parts.friction),
      bias_N_m_(parts.actuator.bias_N_m),
      ripple_(parts.actuator.ripple),
      drag_(std::move(drag)),
      vary_(drag_ || ripple_ || friction_falls()) {}

double AddedForces::offset_N_m(double hub_angle_rad) const {
  if (!ripple_) return bias_N_m_;
  return bias_N_m_ + ripple_->amplitude_N_m *
                         std::sin(ripple_->cycles_per_rev * hub_angle_rad + ripple_->phase_rad);
}

AddedForces::HubTorque AddedForces::hub_torque(const Eigen::VectorXd& x, HubMotion motion) const {
  HubTorque made;
  made.torque_N_m = ripple_ ? offset_N_m(arm_->hub_angle(x)) : bias_N_m_;
  const double sign = direction(motion);
  if (sign == 0.0) return made;
  const double fall = friction_.stribeck_static_N_m - friction_.stribeck_N_m;
  if (fall == 0.0) {
    made.torque_N_m -= sign * friction_.breakaway_N_m();
    return made;
  }
  const double velocity = arm_->hub_velocity(x);
  const double scale = friction_.stribeck_velocity_rad_per_s;
  const double left = fall * std::exp(-(velocity / scale) * (velocity / scale));
  made.torque_N_m -= sign * (friction_.coulomb_N_m + friction_.stribeck_N_m + left);
  made.per_velocity_N_m_s = sign * left * 2.0 * velocity / (scale * scale);
  return made;
}

Eigen::VectorXd AddedForces::force(const Eigen::VectorXd& x, double hub_torque_N_m) const {
  if (!drag_) return arm_->hub_force * hub_torque_N_m;
  return arm_->hub_force * hub_torque_N_m + drag_->modal_force(arm_->velocity(x));
}

std::string_view AddedForces::effect_in_steps() const {
  if (friction_.coulomb_N_m > 0.0) return "coulomb_friction";
  if (!friction_.is_zero()) return "stribeck_friction";
  if (drag_) return "quadratic_drag";
  return ripple_ ? "torque_ripple" : "";
}

double AddedForces::friction_power_W(double hub_velocity_rad_per_s) const {
  return friction_.torque_N_m(hub_velocity_rad_per_s) * std::abs(hub_velocity_rad_per_s);
}

double AddedForces::drag_power_W(const Eigen::VectorXd& x) const {
  return drag_ ? drag_->power_W(arm_->velocity(x)) : 0.0;
}

}  // namespace flexarm::response
