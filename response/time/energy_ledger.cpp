#include "response/time/energy_ledger.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>

namespace flexarm::response {

EnergyLedger::EnergyLedger(const ModalDynamics& arm, const AddedForces& forces,
                           double hub_viscous_friction_N_m_s_per_rad)
    : arm_(&arm), forces_(&forces), hub_viscous_friction_(hub_viscous_friction_N_m_s_per_rad) {}

EnergyLedger::Powers EnergyLedger::powers(const Eigen::VectorXd& x, double actuator_N_m,
                                          double time_s, HubMotion motion) const {
  const double speed = motion == HubMotion::held ? 0.0 : arm_->hub_velocity(x);
  const double torque = arm_->hub_torque.state * x + arm_->hub_torque.actuator * actuator_N_m +
                        forces_->smooth_torque_N_m(x, actuator_N_m, time_s);
  const auto p = arm_->velocity(x);
  Powers made;
  made.work_in = torque * speed;
  made.viscous = hub_viscous_friction_ * speed * speed;
  made.material_air = arm_->modal_mass_kg_m2 * p.dot(arm_->damping * p) - made.viscous;
  if (motion != HubMotion::frictionless) made.dry_friction = forces_->friction_power_W(speed);
  made.drag = forces_->beam_power_W(x);
  return made;
}

void EnergyLedger::add(const Expansion& solution, const StepInputs& inputs, HubMotion motion,
                       double until) {
  using Rule = boost::math::quadrature::gauss<double, 7>;
  const double half = 0.5 * until;
  const auto point = [&](double r, double weight) {
    const Powers power = powers(solution.at(r), inputs.torque(r), inputs.time(r), motion);
    const double duration = weight * half * solution.step_s();
    balance_.work_in_J += duration * power.work_in;
    balance_.viscous_J += duration * power.viscous;
    balance_.material_air_J += duration * power.material_air;
    balance_.dry_friction_J += duration * power.dry_friction;
    balance_.drag_J += duration * power.drag;
  };
  point(half, Rule::weights()[0]);
  for (std::size_t k = 1; k < Rule::abscissa().size(); ++k) {
    point(half * (1.0 - Rule::abscissa()[k]), Rule::weights()[k]);
    point(half * (1.0 + Rule::abscissa()[k]), Rule::weights()[k]);
  }
}

void EnergyLedger::add(const StepEnergy& energy, const StepInputs& inputs, HubMotion motion,
                       const Eigen::VectorXd& begin, const Eigen::VectorXd& end) {
  const StepEnergy::Amounts amounts =
      energy(begin, {.actuator_begin = inputs.u0,
                     .actuator_end = inputs.u1,
                     .added = inputs.f0(0),
                     .added_smooth = forces_->smooth_torque_N_m(begin, inputs.u0, inputs.begin_s)});
  balance_.work_in_J += amounts.work_in_J;
  balance_.viscous_J += amounts.viscous_J;
  balance_.material_air_J += amounts.material_air_J;
  // Friction whose size is constant does work on the angle that the hub turns by.
  const double turned_rad = direction(motion) * (arm_->hub_angle(end) - arm_->hub_angle(begin));
  const double speed_rad_per_s = std::abs(turned_rad) / inputs.length_s;
  balance_.dry_friction_J += forces_->friction_at(speed_rad_per_s).torque_N_m * turned_rad;
}

void EnergyLedger::close_sample(const Eigen::VectorXd& x) {
  const auto q = (x.head(arm_->modes).array() / arm_->scale_rad_per_s.array()).eval();
  balance_.kinetic_J = 0.5 * arm_->modal_mass_kg_m2 * arm_->velocity(x).squaredNorm();
  balance_.potential_J = 0.5 * arm_->modal_mass_kg_m2 * (arm_->stiffness.array() * q * q).sum();
  balance_.largest_residual_J =
      std::max(balance_.largest_residual_J, std::abs(balance_.residual_J()));
  const EnergyBalance& last = at_last_sample_;
  balance_.lowest_loss_J =
      std::min({balance_.lowest_loss_J, balance_.viscous_J - last.viscous_J,
                balance_.material_air_J - last.material_air_J,
                balance_.dry_friction_J - last.dry_friction_J, balance_.drag_J - last.drag_J});
  at_last_sample_ = balance_;
}

}  // namespace flexarm::response
