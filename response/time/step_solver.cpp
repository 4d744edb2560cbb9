#include "response/time/step_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace flexarm::response {

StepSolver::StepSolver(const ModalDynamics& arm, const AddedForces& forces, double force_tolerance,
                       int most_iterations)
    : arm_(&arm),
      forces_(&forces),
      force_tolerance_(force_tolerance),
      allowed_iterations_(most_iterations),
      middle_(arm.size()),
      end_(arm.size()) {}

/// f at the begin of a step, where forces are constant all of f; else a guess for middle and end.
void StepSolver::begin(const Eigen::VectorXd& x, HubMotion motion, const StepSpan& span,
                       bool follows) {
  inputs_.u0 = span.u0;
  inputs_.u1 = span.u1;
  inputs_.begin_s = span.begin_s;
  inputs_.length_s = span.length_s;
  const ArmInstant now{x, span.u0, span.begin_s};
  const auto hub = forces_->hub_torque(now, motion);
  const double torque = hub.torque_N_m;
  if (!forces_->vary()) {
    inputs_.f0.setConstant(1, torque);
    inputs_.fm.setConstant(1, torque);
    inputs_.f1.setConstant(1, torque);
    return;
  }
  if (!follows) {
    inputs_.f0 = forces_->force(now, hub);
    inputs_.fm = inputs_.f0;
    inputs_.f1 = inputs_.f0;
    hub_torques_.fill(torque);
    return;
  }
  // The last step's parabola at r = 3/2 and r = 2.
  const auto go_on = []<class Value>(const Value& begin, Value& middle, Value& end) {
    const Value next = begin - 3.0 * middle + 3.0 * end;
    end = 3.0 * begin - 8.0 * middle + 6.0 * end;
    middle = next;
  };
  go_on(inputs_.f0, inputs_.fm, inputs_.f1);
  go_on(hub_torques_[0], hub_torques_[1], hub_torques_[2]);
  inputs_.f0 = forces_->force(now, hub);
  hub_torques_[0] = torque;
}

bool StepSolver::solve(const StepTable& table, const Eigen::VectorXd& x, HubMotion motion,
                       const StepSpan& span) {
  begin(x, motion, span, motion == last_motion_ && span.length_s == last_length_s_);
  if (!forces_->vary()) {
    end_.noalias() = table.end.state * x;
    end_ += table.end.actuator_begin * span.u0 + table.end.actuator_end * span.u1 +
            table.constant * inputs_.f0(0);
    return true;
  }
  const auto known = [&](const Propagator& to) -> Eigen::VectorXd {
    return to.state * x + to.actuator_begin * span.u0 + to.actuator_end * span.u1 +
           to.force_begin * inputs_.f0;
  };
  const Eigen::VectorXd known_middle = known(table.middle);
  const Eigen::VectorXd known_end = known(table.end);
  last_length_s_ = 0.0;
  for (int iteration = 1; iteration <= allowed_iterations_; ++iteration) {
    middle_ = known_middle;
    middle_ += table.middle.force_middle * inputs_.fm + table.middle.force_end * inputs_.f1;
    end_ = known_end;
    end_ += table.end.force_middle * inputs_.fm + table.end.force_end * inputs_.f1;
    iterations_ = std::max(iterations_, iteration);
    if (!improve(middle_, end_, motion)) continue;
    if (span.must_be_resolved && !is_resolved(x, end_, motion)) return false;
    last_motion_ = motion;
    last_length_s_ = span.length_s;
    return true;
  }
  return false;
}

bool StepSolver::solve_by_series(const Eigen::VectorXd& x, HubMotion motion, const StepSpan& span) {
  begin(x, motion, span, false);
  last_length_s_ = 0.0;
  if (!forces_->vary()) {
    expand(x, motion);
    return true;
  }
  for (int iteration = 1; iteration <= allowed_iterations_; ++iteration) {
    expand(x, motion);
    iterations_ = std::max(iterations_, iteration);
    const Eigen::VectorXd end = series_.at(1.0);
    if (improve(series_.at(0.5), end, motion)) {
      return !span.must_be_resolved || is_resolved(x, end, motion);
    }
  }
  return false;
}

/// True when f at these states is the f they were solved with. Else takes f from them, hub torque N
/// by a Newton step: with the mobility mu of the hub, N changes its speed by Lobatto's weights,
///
///     d theta'(1/2) = mu dt (dNm/3 - dN1/24),   d theta'(1) = mu dt (2 dNm/3 + dN1/6).
bool StepSolver::improve(const Eigen::VectorXd& middle, const Eigen::VectorXd& end,
                         HubMotion motion) {
  const ArmInstant at_middle{middle, inputs_.torque(0.5), inputs_.time(0.5)};
  const ArmInstant at_end{end, inputs_.u1, inputs_.time(1.0)};
  const auto hub_middle = forces_->hub_torque(at_middle, motion);
  const auto hub_end = forces_->hub_torque(at_end, motion);
  const Eigen::VectorXd fm = forces_->force(at_middle, hub_middle);
  const Eigen::VectorXd f1 = forces_->force(at_end, hub_end);
  const auto largest = [](const Eigen::VectorXd& v) { return v.cwiseAbs().maxCoeff(); };
  const double change = std::max(largest(fm - inputs_.fm), largest(f1 - inputs_.f1));
  const double size = std::max({largest(inputs_.f0), largest(fm), largest(f1)});
  if (change <= force_tolerance_ * size) return true;

  const double rm = hub_middle.torque_N_m - hub_torques_[1];
  const double r1 = hub_end.torque_N_m - hub_torques_[2];
  const double mu_dt = inputs_.length_s * arm_->hub_slope.squaredNorm() / arm_->modal_mass_kg_m2;
  const double jm = mu_dt * hub_middle.per_velocity_N_m_s;
  const double j1 = mu_dt * hub_end.per_velocity_N_m_s;
  const double a = 1.0 - jm / 3.0;
  const double b = jm / 24.0;
  const double c = -j1 * 2.0 / 3.0;
  const double d = 1.0 - j1 / 6.0;
  const double determinant = a * d - b * c;
  const double dm = (rm * d - b * r1) / determinant;
  const double d1 = (a * r1 - c * rm) / determinant;
  inputs_.fm = fm + arm_->hub_force * (dm - rm);
  inputs_.f1 = f1 + arm_->hub_force * (d1 - r1);
  hub_torques_[1] += dm;
  hub_torques_[2] += d1;
  return false;
}

/// Friction that changes with speed is a parabola over a step only where the speed changes by a
/// part of the speed over which friction changes, or where friction no longer changes.
bool StepSolver::is_resolved(const Eigen::VectorXd& begin, const Eigen::VectorXd& end,
                             HubMotion motion) const {
  constexpr double kLargestChange = 0.25;
  constexpr double kFlat = 1e-3;  // change over one scale of speed, relative to breakaway
  const double scale = forces_->friction_scale_rad_per_s();
  if (direction(motion) == 0.0 || !std::isfinite(scale)) return true;
  const double v0 = arm_->hub_velocity(begin);
  const double v1 = arm_->hub_velocity(end);
  if (std::abs(v1 - v0) <= kLargestChange * scale) return true;
  const auto slowest = forces_->friction_at(std::min(std::abs(v0), std::abs(v1)));
  return std::abs(slowest.per_speed_N_m_s) * scale <= kFlat * forces_->breakaway_N_m();
}

void StepSolver::expand(const Eigen::VectorXd& x, HubMotion motion) {
  const LinearSystem& system = motion == HubMotion::held ? arm_->held : arm_->turning;
  std::array<Eigen::VectorXd, 3> inputs = {
      system.actuator * inputs_.u0 + system.force * inputs_.f0,
      system.actuator * (inputs_.u1 - inputs_.u0) + system.force * inputs_.force_slope(),
      system.force * inputs_.force_square()};
  if (system.actuator_rate.size() > 0) {
    inputs[0] += system.actuator_rate * ((inputs_.u1 - inputs_.u0) / inputs_.length_s);
  }
  series_.compute(system, inputs_.length_s, x, inputs);
}

}  // namespace flexarm::response
