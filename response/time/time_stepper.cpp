#include "response/time/time_stepper.hpp"

#include "arm/input_error.hpp"
#include "response/time/first_crossing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace flexarm::response {

namespace {

/// |A| dt of an inner step: with 1, the power series has some 20 terms and loses no digit, and no
/// mode turns by more than 1 rad between two looks at the hub.
constexpr double kLargestPhase_rad = 1.0;
/// The same where forces vary: the error of the parabola is then 16 times less.
constexpr double kLargestPhaseVarying_rad = 0.5;
/// Events within the same kInstant of an inner step before the hub is held.
constexpr int kMostEventsAtOnce = 20;
constexpr double kInstant = 1e-9;
/// |R| this near to breakaway is at breakaway: rounding of the sum that forms R.
constexpr double kAtBreakaway = 1e-13;
/// Rests of a step shorter than this times the sample time are not taken.
constexpr double kNothingLeft = 1e-15;
constexpr int kMostHalvings = 30;
/// A linear arm's piece of a length that does not come again is stepped by series up to this many
/// of them; a matrix exponential costs as much.
constexpr double kMostSeriesSteps = 50.0;

HubMotion turning_like(double torque) {
  return torque > 0.0 ? HubMotion::forward : HubMotion::backward;
}

/// Behind step `i` of `count` of a piece.
double torque_behind(int i, int count, const TorquePiece& piece) {
  if (i == count) return piece.end_N_m;
  return piece.begin_N_m + (piece.end_N_m - piece.begin_N_m) * i / count;
}

std::span<const double> as_span(const Eigen::RowVectorXd& series) {
  return {series.data(), static_cast<std::size_t>(series.size())};
}

}  // namespace

TimeStepper::TimeStepper(const ModalDynamics& arm, const AddedForces& forces, bool has_friction,
                         const TorquePath& path, const SimulationOptions& options,
                         EnergyLedger* ledger)
    : arm_(&arm),
      forces_(&forces),
      options_(options),
      ledger_(ledger),
      has_friction_(has_friction),
      is_linear_(!has_friction && !forces.vary()),
      x_(Eigen::VectorXd::Zero(arm.size())),
      motion_(has_friction ? HubMotion::held : HubMotion::frictionless),
      breakaway_N_m_(forces.breakaway_N_m()),
      solver_(arm, forces, options.force_tolerance, options.most_iterations) {
  const double h = options.sample_time_s;
  const double phi = path.delay_fraction();
  velocity_row_.setZero(arm.size());
  velocity_row_.segment(arm.modes, arm.modes) = arm.hub_slope.transpose();
  summary_.substeps = substeps(h);
  if (phi == 0.0) {
    regular_[0] = steps(h);
  } else {
    regular_[1] = steps(phi * h);
    regular_[2] = steps((1.0 - phi) * h);
  }
}

int TimeStepper::substeps(double length_s) const {
  const double h = options_.sample_time_s;
  double count = std::ceil(options_.substeps * length_s / h - 1e-9);
  if (!is_linear_) {
    const double phase = forces_->vary() ? kLargestPhaseVarying_rad : kLargestPhase_rad;
    count = std::max(count, std::ceil(arm_->fastest_rate_rad_per_s * length_s / phase));
  }
  if (!(count <= kMostSubsteps)) {
    throw arm::InputError(fmt::format(
        "effects.{}: needs {:g} inner steps a sample of {} s for an arm with a rate of "
        "{:g} rad/s; must be {} or fewer: damp the arm less, or sample it faster",
        forces_->effect_in_steps(), count, h, arm_->fastest_rate_rad_per_s, kMostSubsteps));
  }
  return std::max(1, static_cast<int>(count));
}

TimeStepper::Steps TimeStepper::steps(double length_s) const {
  Steps made;
  made.count = substeps(length_s);
  made.length_s = length_s / made.count;
  const Reading speed = {velocity_row_, 0.0, Eigen::RowVectorXd::Zero(arm_->turning.force.cols())};
  made.turning =
      step_table(arm_->turning, has_friction_ ? &speed : nullptr, made.length_s, forces_->vary());
  if (has_friction_) {
    made.held = step_table(arm_->held, &arm_->reaction, made.length_s, forces_->vary());
  }
  if (is_linear_ && ledger_ != nullptr) made.energy = ledger_->step_energy(made.length_s);
  return made;
}

double TimeStepper::hub_angle() const {
  return motion_ == HubMotion::held ? held_angle_rad_ : arm_->hub_angle(x_);
}

Eigen::VectorXd TimeStepper::force() const {
  return forces_->force(x_, forces_->hub_torque(x_, motion_).torque_N_m);
}

double TimeStepper::hub_torque_N_m(double actuator_N_m) const {
  return arm_->hub_torque.state.dot(x_) + arm_->hub_torque.actuator * actuator_N_m +
         forces_->offset_N_m(hub_angle());
}

double TimeStepper::reaction(const Eigen::VectorXd& x, double u) const {
  const Eigen::VectorXd f = forces_->force(x, forces_->offset_N_m(arm_->hub_angle(x)));
  return arm_->reaction.state.dot(x) + arm_->reaction.actuator * u + arm_->reaction.force.dot(f);
}

void TimeStepper::take_up(double torque_N_m, double now_s) {
  time_s_ = now_s;
  if (has_friction_ && start_ != Start::inside && torque_N_m != last_torque_N_m_) {
    // It came to a turn at this very instant: what the torque was to do then no longer counts.
    motion_ = HubMotion::held;
    held_angle_rad_ = arm_->hub_angle(x_);
    start_ = Start::inside;
  }
  if (motion_ != HubMotion::held) return;
  const double needed = reaction(x_, torque_N_m);
  if (std::abs(needed) <= breakaway_N_m_) return;
  motion_ = turning_like(needed);
  start_ = Start::hub_speed_zero;
  ++summary_.breakaways;
  record_event();
}

void TimeStepper::put(const Eigen::VectorXd& state, bool held) {
  x_ = state;
  start_ = Start::inside;
  events_at_once_ = 0;
  if (!has_friction_) return;
  const double speed = arm_->hub_velocity(x_);
  if (held || speed == 0.0) {
    motion_ = HubMotion::held;
    arm_->stop_hub(x_);
    held_angle_rad_ = arm_->hub_angle(x_);
  } else {
    motion_ = turning_like(speed);
  }
}

void TimeStepper::advance(const TorquePiece& piece, double now_s) {
  time_s_ = now_s;
  last_torque_N_m_ = piece.end_N_m;
  if (piece.length != TorquePiece::Length::other) {
    advance_in(regular_[static_cast<std::size_t>(piece.length)], piece);
    return;
  }
  const double length_s = (piece.end - piece.begin) * options_.sample_time_s;
  const double least = std::ceil(arm_->fastest_rate_rad_per_s * length_s / kLargestPhase_rad);
  if (is_linear_ && least > kMostSeriesSteps) {
    advance_in(steps(length_s), piece);
    return;
  }
  const int count = std::max(substeps(length_s), static_cast<int>(least));
  double u0 = piece.begin_N_m;
  for (int i = 1; i <= count; ++i) {
    const double u1 = torque_behind(i, count, piece);
    free_step(length_s / count, u0, u1, 0);
    u0 = u1;
  }
}

void TimeStepper::advance_in(const Steps& steps, const TorquePiece& piece) {
  double u0 = piece.begin_N_m;
  for (int i = 1; i <= steps.count; ++i) {
    const double u1 = torque_behind(i, steps.count, piece);
    if (is_linear_) {
      linear_step(steps, u0, u1);
    } else {
      step(steps, u0, u1);
    }
    u0 = u1;
  }
}

void TimeStepper::linear_step(const Steps& steps, double u0, double u1) {
  solver_.solve(steps.turning, x_, motion_, steps.length_s, u0, u1);
  if (steps.energy) ledger_->add((*steps.energy)(x_, u0, u1, solver_.inputs().f0(0)));
  finish(solver_.end(), steps.length_s);
}

void TimeStepper::step(const Steps& steps, double u0, double u1) {
  const StepTable& table = motion_ == HubMotion::held ? steps.held : steps.turning;
  if (!solver_.solve(table, x_, motion_, steps.length_s, u0, u1)) {
    halve(steps.length_s, u0, u1, 0);
    return;
  }
  const bool may_happen = has_friction_ && !is_quiet(table, solver_.end());
  if (may_happen || ledger_ != nullptr) {
    solver_.expand(x_, motion_, steps.length_s);
    const std::optional<double> event = may_happen ? next_event() : std::nullopt;
    book(event.value_or(1.0));
    if (event) {
      const double between = solver_.inputs().torque(*event);
      happen(*event, steps.length_s);
      free_step((1.0 - *event) * steps.length_s, between, u1, 0);
      return;
    }
  }
  finish(solver_.end(), steps.length_s);
}

void TimeStepper::free_step(double length_s, double u0, double u1, int halvings) {
  while (length_s > kNothingLeft * options_.sample_time_s) {
    if (!solver_.solve_by_series(x_, motion_, length_s, u0, u1)) {
      halve(length_s, u0, u1, halvings);
      return;
    }
    const bool is_forced = events_at_once_ > kMostEventsAtOnce;
    const std::optional<double> event = has_friction_ && !is_forced ? next_event() : std::nullopt;
    book(event.value_or(1.0));
    if (!event) {
      if (is_forced) ++summary_.forced_rests;
      finish(solver_.series().at(1.0), length_s);
      return;
    }
    u0 = solver_.inputs().torque(*event);
    happen(*event, length_s);
    length_s *= 1.0 - *event;
  }
}

void TimeStepper::book(double until) {
  if (ledger_ != nullptr) ledger_->add(solver_.series(), solver_.inputs(), motion_, until);
}

void TimeStepper::halve(double length_s, double u0, double u1, int halvings) {
  if (halvings >= kMostHalvings) {
    throw std::runtime_error(fmt::format(
        "simulation: the forces of an inner step at {} s do not converge, however short it is",
        time_s_));
  }
  ++summary_.halved_steps;
  const double between = 0.5 * (u0 + u1);
  free_step(0.5 * length_s, u0, between, halvings + 1);
  free_step(0.5 * length_s, between, u1, halvings + 1);
}

bool TimeStepper::is_quiet(const StepTable& table, const Eigen::VectorXd& end) const {
  if (start_ != Start::inside) return false;
  const StepInputs& inputs = solver_.inputs();
  const double sag = forces_->vary() ? table.sag(x_, inputs)
                                     : table.sag.of_constant(
                                           x_, std::max(std::abs(inputs.u0), std::abs(inputs.u1)),
                                           std::abs(inputs.u1 - inputs.u0), std::abs(inputs.f0(0)));
  if (motion_ == HubMotion::held) {
    const double most =
        std::max(std::abs(reaction(x_, inputs.u0)), std::abs(reaction(end, inputs.u1)));
    return most + sag < breakaway_N_m_;
  }
  const double sign = direction(motion_);
  return std::min(sign * arm_->hub_velocity(x_), sign * arm_->hub_velocity(end)) > sag;
}

std::optional<double> TimeStepper::next_event() const {
  if (motion_ != HubMotion::held) {
    const Eigen::RowVectorXd speed = direction(motion_) * solver_.series().of(velocity_row_);
    // Known zeros at r = 0 are divided out.
    const std::size_t zeros = start_ == Start::inside ? 0 : start_ == Start::hub_speed_zero ? 1 : 2;
    return first_crossing(as_span(speed).subspan(zeros));
  }
  const StepInputs& inputs = solver_.inputs();
  Eigen::RowVectorXd needed = solver_.series().of(arm_->reaction.state);
  needed(0) += arm_->reaction.actuator * inputs.u0 + arm_->reaction.force.dot(inputs.f0);
  needed(1) += arm_->reaction.actuator * (inputs.u1 - inputs.u0) +
               arm_->reaction.force.dot(inputs.force_slope());
  needed(2) += arm_->reaction.force.dot(inputs.force_square());
  std::optional<double> first;
  for (const double sign : {1.0, -1.0}) {
    Eigen::RowVectorXd margin = -sign * needed;
    margin(0) += breakaway_N_m_;
    const bool at_edge = std::abs(margin(0)) <= kAtBreakaway * breakaway_N_m_;
    const auto crossing = first_crossing(as_span(margin).subspan(at_edge ? 1 : 0));
    if (crossing && (!first || *crossing < *first)) first = crossing;
  }
  return first;
}

void TimeStepper::happen(double r, double length_s) {
  const double passed_s = r * length_s;
  const double u = solver_.inputs().torque(r);
  const bool was_held = motion_ == HubMotion::held;
  x_ = solver_.series().at(r);
  arm_->stop_hub(x_);
  time_s_ += passed_s;
  ++summary_.inner_steps;
  if (was_held) {
    summary_.stick_time_s += passed_s;
    arm_->set_hub_angle(x_, held_angle_rad_);
  }
  events_at_once_ = r > kInstant ? 0 : events_at_once_ + 1;
  const double needed = reaction(x_, u);
  if (was_held && events_at_once_ <= kMostEventsAtOnce) {
    motion_ = turning_like(needed);
    start_ = Start::hub_acceleration_zero;
    ++summary_.breakaways;
  } else if (std::abs(needed) <= breakaway_N_m_ || events_at_once_ > kMostEventsAtOnce) {
    motion_ = HubMotion::held;
    start_ = Start::inside;
    held_angle_rad_ = arm_->hub_angle(x_);
    ++summary_.stops;
  } else {
    if (motion_ != turning_like(needed)) ++summary_.reversals;
    motion_ = turning_like(needed);
    start_ = Start::hub_speed_zero;
  }
  record_event();
}

void TimeStepper::record_event() {
  if (summary_.event_times_s.size() < kRecordedEvents) summary_.event_times_s.push_back(time_s_);
}

void TimeStepper::finish(const Eigen::VectorXd& end, double duration_s) {
  x_ = end;
  if (motion_ == HubMotion::held) {
    arm_->stop_hub(x_);
    arm_->set_hub_angle(x_, held_angle_rad_);
    summary_.stick_time_s += duration_s;
  }
  start_ = Start::inside;
  events_at_once_ = 0;
  time_s_ += duration_s;
  ++summary_.inner_steps;
}

}  // namespace flexarm::response
