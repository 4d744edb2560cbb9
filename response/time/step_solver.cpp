#include "response/time/step_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace flexarm::response {

namespace {

/// Of the tolerance over the next iteration's estimated change, with which that is left out.
constexpr double kMargin = 10.0;

/// Largest change of speed in a step that is resolved, in scales of speed of friction; and that
/// after the first iteration, which the next ones may still bring below it.
constexpr double kResolved = 0.25;
constexpr double kRoughlyResolved = 0.5;

}  // namespace

StepSolver::StepSolver(const ModalDynamics& arm, const AddedForces& forces, double force_tolerance,
                       int most_iterations, bool turns_states)
    : arm_(&arm),
      forces_(&forces),
      force_tolerance_(force_tolerance),
      allowed_iterations_(most_iterations),
      turns_states_(turns_states && forces.states_move_by_turn()) {}

/// f at the beginning, and a guess for f at middle and end, which is exact where forces are
/// constant: that at the beginning, or where the step `follows` another of its length the parabola
/// of that.
void StepSolver::form_inputs(const ArmState& now, HubMotion motion, const StepSpan& span,
                             bool follows) {
  inputs_.u0 = span.u0;
  inputs_.u1 = span.u1;
  inputs_.begin_s = span.begin_s;
  inputs_.length_s = span.length_s;
  const ForceInstant instant{entries(now.arguments), span.u0, span.begin_s};
  if (follows && forces_->vary()) {
    // The last step's parabola at r = 3/2 and r = 2.
    const auto go_on = [](double begin, double& middle, double& end) {
      const double next = begin - 3.0 * middle + 3.0 * end;
      end = 3.0 * begin - 8.0 * middle + 6.0 * end;
      middle = next;
    };
    for (Eigen::Index i = 0; i < inputs_.f0.size(); ++i) {
      go_on(inputs_.f0(i), inputs_.fm(i), inputs_.f1(i));
    }
    go_on(hub_torques_[0], hub_torques_[1], hub_torques_[2]);
    hub_torques_[0] = forces_->form(instant, motion, now.along_beam, inputs_.f0).torque_N_m;
    return;
  }
  hub_torques_.fill(forces_->form(instant, motion, now.along_beam, inputs_.f0).torque_N_m);
  inputs_.fm = inputs_.f0;
  inputs_.f1 = inputs_.f0;
}

/// All that StepTable::end maps but f at middle and end.
void StepSolver::form_known(const StepTable& table, const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  known_.resize(table.end.cols());
  known_.head(n) = x;
  known_(n) = inputs_.u0;
  known_(n + 1) = inputs_.u1;
  known_.segment(n + 2, inputs_.f0.size()) = inputs_.f0;
}

bool StepSolver::solve(const StepTable& table, const ArmState& now, HubMotion motion,
                       const StepSpan& span) {
  form_inputs(now, motion, span, motion == last_motion_ && span.length_s == last_length_s_);
  form_known(table, now.x);
  if (!forces_->vary()) {
    end_.noalias() = table.end * known_;
    return true;
  }
  last_length_s_ = 0.0;
  const Eigen::Index forces = inputs_.f0.size();
  known_arguments_.noalias() = table.arguments_by_known * known_.head(known_.size() - 2 * forces);
  const std::size_t count = static_cast<std::size_t>(known_arguments_.size()) / 2;
  const auto is_within = [&](double resolved, double end_rad_per_s) {
    return !span.must_be_resolved || is_resolved(AddedForces::hub_velocity(entries(now.arguments)),
                                                 end_rad_per_s, motion, resolved);
  };
  double change = 0.0;
  double rate = 0.0;  // of convergence
  for (int iteration = 1; iteration <= allowed_iterations_; ++iteration) {
    known_.tail(2 * forces) << inputs_.fm, inputs_.f1;
    arguments_ = known_arguments_;
    arguments_.noalias() += table.arguments_by_forces * known_.tail(2 * forces);
    const auto middle = entries(arguments_).first(count);
    const auto end = entries(arguments_).last(count);
    const bool is_turned = try_turn(now, middle, end);
    evaluate(middle, 0.5, motion, middle_point_);
    evaluate(end, 1.0, motion, end_point_);
    iterations_ = std::max(iterations_, iteration);
    const double end_speed = AddedForces::hub_velocity(end);
    if (iteration == 1 && !is_within(kRoughlyResolved, end_speed)) return false;
    const double last_change = change;
    change = relative_change(is_turned);
    improve();
    if (is_turned) take_mean_rates(now, end);
    double estimate = change;
    if (iteration > 1) {
      rate = std::max(rate, change / last_change);
      estimate *= std::min(1.0, kMargin * std::max(rate, last_rate_));
    }
    if (!(estimate <= force_tolerance_)) continue;
    if (!is_within(kResolved, end_speed)) return false;
    if (turns_states_ && !are_states_resolved(now, middle, end, is_turned)) return false;
    if (span.must_be_resolved && !are_laws_resolved(now, middle, end, motion)) return false;
    known_.tail(3 * forces) << inputs_.f0, inputs_.fm, inputs_.f1;
    end_.noalias() = table.end * known_;
    if (rate > 0.0) last_rate_ = rate;
    last_motion_ = motion;
    last_length_s_ = span.length_s;
    return true;
  }
  return false;
}

bool StepSolver::solve_by_series(const ArmState& now, HubMotion motion, const StepSpan& span) {
  form_inputs(now, motion, span, false);
  last_length_s_ = 0.0;
  if (!forces_->vary()) {
    expand(now.x, motion);
    end_ = series_.at(1.0);
    return true;
  }
  for (int iteration = 1; iteration <= allowed_iterations_; ++iteration) {
    expand(now.x, motion);
    iterations_ = std::max(iterations_, iteration);
    middle_ = series_.at(0.5);
    forces_->form_arguments(middle_, middle_arguments_);
    end_ = series_.at(1.0);
    forces_->form_arguments(end_, arguments_);
    const auto middle = entries(middle_arguments_);
    const auto end = entries(arguments_);
    const bool is_turned = try_turn(now, middle, end);
    evaluate(middle, 0.5, motion, middle_point_);
    evaluate(end, 1.0, motion, end_point_);
    if (relative_change(is_turned) <= force_tolerance_) {
      if (turns_states_ && !are_states_resolved(now, middle, end, is_turned)) return false;
      if (is_turned) {
        take_mean_rates(now, end);
        expand(now.x, motion);
        end_ = series_.at(1.0);
      }
      return !span.must_be_resolved ||
             (are_laws_resolved(now, middle, end, motion) &&
              is_resolved(AddedForces::hub_velocity(entries(now.arguments)),
                          AddedForces::hub_velocity(end), motion, kResolved));
    }
    improve();
    if (is_turned) take_mean_rates(now, end);
  }
  return false;
}

/// Where the hub turns one way writes the states of laws at middle and end by its turn.
bool StepSolver::try_turn(const ArmState& now, std::span<double> middle,
                          std::span<double> end) const {
  if (!turns_states_) return false;
  const auto begin = entries(now.arguments);
  const double speed = AddedForces::hub_velocity(begin);
  if (!(speed * AddedForces::hub_velocity(middle) > 0.0) ||
      !(speed * AddedForces::hub_velocity(end) > 0.0)) {
    return false;
  }
  forces_->turn_states(begin, middle);
  forces_->turn_states(begin, end);
  return true;
}

/// Each state hardly moves; or the hub turns one way, and it moves as far in the second half as in
/// the first, but for a half: a parabola goes through that.
bool StepSolver::are_states_resolved(const ArmState& now, std::span<const double> middle,
                                     std::span<const double> end, bool is_turned) const {
  constexpr double kHardly = 0.01;
  constexpr double kLeastPart = 0.5;
  const auto before = forces_->law_states(entries(now.arguments));
  const auto between = forces_->law_states(middle);
  const auto after = forces_->law_states(end);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double first = std::abs(between[i] - before[i]);
    const double second = std::abs(after[i] - between[i]);
    const double more = std::max(first, second);
    const bool is_even = is_turned && std::min(first, second) >= kLeastPart * more;
    if (!is_even && !(more <= kHardly)) return false;
  }
  return true;
}

/// Rates by which the states of laws come to what they are at the end.
void StepSolver::take_mean_rates(const ArmState& now, std::span<const double> end) {
  const auto before = forces_->law_states(entries(now.arguments));
  const auto after = forces_->law_states(end);
  const Eigen::Index first = inputs_.f0.size() - std::ssize(after);
  for (std::size_t i = 0; i < after.size(); ++i) {
    const double rate = (after[i] - before[i]) / inputs_.length_s;
    const Eigen::Index at = first + static_cast<Eigen::Index>(i);
    inputs_.f0(at) = inputs_.fm(at) = inputs_.f1(at) = rate;
  }
}

void StepSolver::evaluate(std::span<const double> arguments, double r, HubMotion motion,
                          Point& point) const {
  forces_->form_along_beam(arguments, point.along_beam);
  point.hub = forces_->form({arguments, inputs_.torque(r), inputs_.time(r)}, motion,
                            point.along_beam, point.force);
}

/// The largest change from f in inputs_ to the f that it leads to, at middle and end, relative to
/// the largest f; without the rates of laws' states that are turned.
double StepSolver::relative_change(bool is_turned) const {
  const Eigen::Index counted = inputs_.f0.size() - (is_turned ? arm_->law_state_count : 0);
  const auto largest = [counted](const auto& v) { return v.head(counted).cwiseAbs().maxCoeff(); };
  const double change =
      std::max(largest(middle_point_.force - inputs_.fm), largest(end_point_.force - inputs_.f1));
  const double size =
      std::max({largest(inputs_.f0), largest(middle_point_.force), largest(end_point_.force)});
  return size > 0.0 ? change / size : change;
}

/// Takes f at middle and end from the states that the last f leads to, hub torque N by a Newton
/// step: with the mobility mu of the hub, N changes its speed by Lobatto's weights,
///
///     d theta'(1/2) = mu dt (dNm/3 - dN1/24),   d theta'(1) = mu dt (2 dNm/3 + dN1/6).
void StepSolver::improve() {
  const double rm = middle_point_.hub.torque_N_m - hub_torques_[1];
  const double r1 = end_point_.hub.torque_N_m - hub_torques_[2];
  const double mu_dt = inputs_.length_s * arm_->hub_slope.squaredNorm() / arm_->modal_mass_kg_m2;
  const double jm = mu_dt * middle_point_.hub.per_velocity_N_m_s;
  const double j1 = mu_dt * end_point_.hub.per_velocity_N_m_s;
  const double a = 1.0 - jm / 3.0;
  const double b = jm / 24.0;
  const double c = -j1 * 2.0 / 3.0;
  const double d = 1.0 - j1 / 6.0;
  const double determinant = a * d - b * c;
  const double dm = (rm * d - b * r1) / determinant;
  const double d1 = (a * r1 - c * rm) / determinant;
  inputs_.fm = middle_point_.force + arm_->hub_force * (dm - rm);
  inputs_.f1 = end_point_.force + arm_->hub_force * (d1 - r1);
  hub_torques_[1] += dm;
  hub_torques_[2] += d1;
}

/// Friction that changes with speed is a parabola over a step only where the speed changes by a
/// part of the speed over which friction changes, or where friction no longer changes.
bool StepSolver::is_resolved(double begin_rad_per_s, double end_rad_per_s, HubMotion motion,
                             double largest_change) const {
  constexpr double kFlat = 1e-3;  // change over one scale of speed, relative to breakaway
  const double scale = forces_->friction_scale_rad_per_s();
  if (direction(motion) == 0.0 || !std::isfinite(scale)) return true;
  if (std::abs(end_rad_per_s - begin_rad_per_s) <= largest_change * scale) return true;
  const auto slowest =
      forces_->friction_at(std::min(std::abs(begin_rad_per_s), std::abs(end_rad_per_s)));
  return std::abs(slowest.per_speed_N_m_s) * scale <= kFlat * forces_->breakaway_N_m();
}

/// The torque of smooth laws is a parabola over the step: at its quarters, for arguments that are
/// parabolas too.
bool StepSolver::are_laws_resolved(const ArmState& now, std::span<const double> middle,
                                   std::span<const double> end, HubMotion motion) {
  constexpr double kParabolic = 0.01;  // of the largest torque
  if (!forces_->has_smooth_laws()) return true;
  // Of all steps so far: where a torque passes 0, as at a kink of a law, that of a step vanishes.
  double& largest = largest_torque_N_m_;
  largest = std::max({largest, std::abs(inputs_.u0), std::abs(inputs_.u1)});
  for (const double torque : hub_torques_) largest = std::max(largest, std::abs(torque));
  const auto begin = entries(now.arguments);
  law_arguments_.resize(std::ssize(end));
  for (const double r : {0.25, 0.75}) {
    const double of_begin = (1.0 - r) * (1.0 - 2.0 * r);
    const double of_middle = 4.0 * r * (1.0 - r);
    const double of_end = r * (2.0 * r - 1.0);
    for (std::size_t i = 0; i < end.size(); ++i) {
      law_arguments_(static_cast<Eigen::Index>(i)) =
          of_begin * begin[i] + of_middle * middle[i] + of_end * end[i];
    }
    const ForceInstant instant{entries(law_arguments_), inputs_.torque(r), inputs_.time(r)};
    const double parabola =
        of_begin * hub_torques_[0] + of_middle * hub_torques_[1] + of_end * hub_torques_[2];
    const double torque = forces_->hub_torque_N_m(instant, motion, law_rates_);
    if (!(std::abs(torque - parabola) <= kParabolic * largest)) return false;
  }
  return true;
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
