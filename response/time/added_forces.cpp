#include "response/time/added_forces.hpp"

#include "arm/linear_arm.hpp"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace flexarm::response {

AddedForces::AddedForces(const ModalDynamics& arm, const HubLaws& hub,
                         std::optional<BeamForces> beam)
    : arm_(&arm),
      hub_(hub),
      beam_(std::move(beam)),
      friction_scale_rad_per_s_(hub_.friction_scale_rad_per_s()),
      breakaway_N_m_(hub_.friction_at(0.0).torque_N_m),
      vary_(beam_ || !hub_.smooth.empty() || std::isfinite(friction_scale_rad_per_s_)) {}

arm::HubState AddedForces::hub_state(const ArmInstant& now) const {
  return {arm_->hub_angle(now.x), arm_->hub_velocity(now.x),
          arm_->hub_torque.state.dot(now.x) + arm_->hub_torque.actuator * now.actuator_N_m,
          now.time_s};
}

AddedForces::HubTorque AddedForces::smooth_torque(const ArmInstant& now) const {
  HubTorque made{.torque_N_m = hub_.constant_N_m};
  if (hub_.smooth.empty()) return made;
  const arm::HubState hub = hub_state(now);
  const auto own = arm_->law_states(now.x);
  made.rates.resize(own.size());
  std::size_t first = 0;
  for (const auto& [effect, law] : hub_.smooth) {
    const auto count = static_cast<std::size_t>(law.states);
    const auto value =
        law.law(hub, own.subspan(first, count), std::span(made.rates).subspan(first, count));
    made.torque_N_m += value.torque_N_m;
    made.per_velocity_N_m_s += value.per_velocity_N_m_s;
    first += count;
  }
  return made;
}

AddedForces::HubTorque AddedForces::hub_torque(const ArmInstant& now, HubMotion motion) const {
  HubTorque made = smooth_torque(now);
  const double sign = direction(motion);
  if (sign == 0.0) return made;
  if (!std::isfinite(friction_scale_rad_per_s_)) {
    made.torque_N_m -= sign * breakaway_N_m_;
    return made;
  }
  const double velocity = arm_->hub_velocity(now.x);
  const auto size = hub_.friction_at(std::abs(velocity));
  made.torque_N_m -= sign * size.torque_N_m;
  made.per_velocity_N_m_s -= sign * (velocity < 0.0 ? -size.per_speed_N_m_s : size.per_speed_N_m_s);
  return made;
}

Eigen::VectorXd AddedForces::force(const ArmInstant& now, const HubTorque& hub) const {
  Eigen::VectorXd made = arm_->hub_force * hub.torque_N_m;
  if (beam_) made.head(arm_->modes) += beam_->modal_force(arm_->velocity(now.x));
  const auto states = static_cast<Eigen::Index>(hub.rates.size());
  made.tail(states) = Eigen::VectorXd::Map(hub.rates.data(), states);
  return made;
}

std::string_view AddedForces::effect_in_steps() const {
  if (has_friction()) return hub_.friction.front().effect;
  if (beam_) return beam_->effect();
  return hub_.smooth.empty() ? std::string_view() : hub_.smooth.front().effect;
}

double AddedForces::friction_power_W(double hub_velocity_rad_per_s) const {
  const double speed = std::abs(hub_velocity_rad_per_s);
  return hub_.friction_at(speed).torque_N_m * speed;
}

double AddedForces::beam_power_W(const Eigen::VectorXd& x) const {
  return beam_ ? beam_->power_W(arm_->velocity(x)) : 0.0;
}

AddedForces added_forces(const ModalDynamics& arm, const arm::ModalModel& model,
                         const ArmParts& parts) {
  std::optional<BeamForces> beam;
  if (!parts.beam_forces.empty()) {
    beam.emplace(model, arm::linear_arm(parts.linear).length_m, parts.beam_forces);
  }
  return {arm, parts.hub, std::move(beam)};
}

}  // namespace flexarm::response
