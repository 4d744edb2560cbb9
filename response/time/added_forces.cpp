#include "response/time/added_forces.hpp"

#include "arm/linear_arm.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace flexarm::response {

AddedForces::AddedForces(const ModalDynamics& arm, const HubLaws& hub,
                         std::optional<BeamForces> beam)
    : arm_(&arm),
      hub_(hub),
      beam_(std::move(beam)),
      friction_scale_rad_per_s_(hub_.friction_scale_rad_per_s()),
      breakaway_N_m_(hub_.friction_at(0.0).torque_N_m),
      vary_(beam_ || !hub_.smooth.empty() || std::isfinite(friction_scale_rad_per_s_)),
      states_move_by_turn_(arm.law_state_count > 0 &&
                           std::ranges::all_of(hub_.smooth, [](const auto& of_effect) {
                             return of_effect.part.states == 0 || of_effect.part.after_turn;
                           })) {}

Eigen::Index AddedForces::argument_count() const {
  if (!vary_) return 0;
  return static_cast<Eigen::Index>(kLawStates) + arm_->law_state_count + (beam_ ? arm_->modes : 0);
}

void AddedForces::form_arguments(const Eigen::VectorXd& x, Eigen::VectorXd& arguments) const {
  arguments.resize(argument_count());
  if (!vary_) return;
  arguments(kAngle) = arm_->hub_angle(x);
  arguments(kVelocity) = arm_->hub_velocity(x);
  arguments(kLaggedTorque) = arm_->hub_torque.state.dot(x);
  arguments.segment(kLawStates, arm_->law_state_count) = arm_->law_states(x);
  if (beam_) arguments.tail(arm_->modes) = arm_->velocity(x);
}

Eigen::MatrixXd AddedForces::argument_rows() const {
  Eigen::MatrixXd made(argument_count(), arm_->size());
  Eigen::VectorXd of_unit;
  for (Eigen::Index i = 0; i < arm_->size(); ++i) {
    form_arguments(Eigen::VectorXd::Unit(arm_->size(), i), of_unit);
    made.col(i) = of_unit;
  }
  return made;
}

void AddedForces::turn_states(std::span<const double> from, std::span<double> arguments) const {
  const double turn_rad = arguments[kAngle] - from[kAngle];
  std::size_t first = kLawStates;
  for (const auto& [effect, law] : hub_.smooth) {
    const auto count = static_cast<std::size_t>(law.states);
    if (count == 0) continue;
    law.after_turn(turn_rad, from.subspan(first, count), arguments.subspan(first, count));
    first += count;
  }
}

void AddedForces::update(ArmState& state) const {
  form_arguments(state.x, state.arguments);
  form_along_beam(entries(state.arguments), state.along_beam);
}

void AddedForces::form_along_beam(std::span<const double> arguments, Eigen::VectorXd& made) const {
  if (!beam_) return;
  beam_->modal_force(arguments.last(static_cast<std::size_t>(arm_->modes)), made);
}

AddedForces::HubTorque AddedForces::smooth_torque(const ForceInstant& now,
                                                  std::span<double> rates) const {
  HubTorque made{.torque_N_m = hub_.constant_N_m};
  if (hub_.smooth.empty()) return made;
  const arm::HubState hub = {
      now.arguments[kAngle], now.arguments[kVelocity],
      now.arguments[kLaggedTorque] + arm_->hub_torque.actuator * now.actuator_N_m, now.time_s};
  const auto own = now.arguments.subspan(kLawStates, rates.size());
  std::size_t first = 0;
  for (const auto& [effect, law] : hub_.smooth) {
    const auto count = static_cast<std::size_t>(law.states);
    const auto value = law.law(hub, own.subspan(first, count), rates.subspan(first, count));
    made.torque_N_m += value.torque_N_m;
    made.per_velocity_N_m_s += value.per_velocity_N_m_s;
    first += count;
  }
  return made;
}

AddedForces::HubTorque AddedForces::hub_torque(const ForceInstant& now, HubMotion motion,
                                               std::span<double> rates) const {
  HubTorque made = smooth_torque(now, rates);
  const double sign = direction(motion);
  if (sign == 0.0) return made;
  if (!std::isfinite(friction_scale_rad_per_s_)) {
    made.torque_N_m -= sign * breakaway_N_m_;
    return made;
  }
  const double velocity = now.arguments[kVelocity];
  const auto size = hub_.friction_at(std::abs(velocity));
  made.torque_N_m -= sign * size.torque_N_m;
  made.per_velocity_N_m_s -= sign * (velocity < 0.0 ? -size.per_speed_N_m_s : size.per_speed_N_m_s);
  return made;
}

double AddedForces::hub_torque_N_m(const ForceInstant& now, HubMotion motion,
                                   Eigen::VectorXd& rates) const {
  rates.resize(arm_->law_state_count);
  return hub_torque(now, motion, entries(rates)).torque_N_m;
}

AddedForces::HubTorque AddedForces::form(const ForceInstant& now, HubMotion motion,
                                         const Eigen::VectorXd& along_beam,
                                         Eigen::VectorXd& made) const {
  const auto states = static_cast<std::size_t>(arm_->law_state_count);
  const Eigen::Index arm_forces = arm_->hub_force.size() - arm_->law_state_count;
  made.resize(arm_->hub_force.size());
  const HubTorque hub = hub_torque(now, motion, entries(made).last(states));
  made.head(arm_forces) = arm_->hub_force.head(arm_forces) * hub.torque_N_m;
  if (beam_) made.head(arm_forces) += along_beam;
  return hub;
}

double AddedForces::smooth_torque_N_m(const Eigen::VectorXd& x, double actuator_N_m,
                                      double time_s) const {
  Eigen::VectorXd arguments;
  form_arguments(x, arguments);
  Eigen::VectorXd rates(arm_->law_state_count);
  return smooth_torque({entries(arguments), actuator_N_m, time_s}, entries(rates)).torque_N_m;
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
