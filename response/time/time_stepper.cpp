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

/// Events within the same kInstant of an inner step before the hub is held.
constexpr int kMostEventsAtOnce = 20;
constexpr double kInstant = 1e-9;
/// |R| this near to breakaway is at breakaway: rounding of the sum that forms R.
constexpr double kAtBreakaway = 1e-13;
/// Rests of a step shorter than this times the sample time are not taken.
constexpr double kNothingLeft = 1e-15;
constexpr int kMostHalvings = 30;
/// A run is held to SimulationOptions::most_steps_per_sample from here on.
constexpr std::int64_t kLeastSteps = 50'000;
/// A linear arm's piece of a length that does not come again is stepped by series up to this many
/// of them; a matrix exponential costs as much.
constexpr double kMostSeriesSteps = 50.0;

HubMotion turning_like(double torque) {
  return torque > 0.0 ? HubMotion::forward : HubMotion::backward;
}

/// Behind step `i` of `count` of a torque that goes straight from `u0` to `u1`.
double torque_behind(int i, int count, double u0, double u1) {
  if (i == count) return u1;
  return u0 + (u1 - u0) * i / count;
}

/// The fewest steps by power series over that length.
double series_steps(const ModalDynamics& arm, double length_s) {
  return std::ceil(phase_rad(arm, length_s) / kLargestPhase_rad);
}

std::span<const double> as_span(const Eigen::RowVectorXd& series) {
  return {series.data(), static_cast<std::size_t>(series.size())};
}

}  // namespace

TimeStepper::TimeStepper(const StepPlan& plan, EnergyLedger* ledger)
    : plan_(&plan),
      arm_(&plan.arm()),
      forces_(&plan.forces()),
      ledger_(ledger),
      state_{.x = Eigen::VectorXd::Zero(plan.arm().size()), .arguments = {}, .along_beam = {}},
      motion_(plan.forces().has_friction() ? HubMotion::held : HubMotion::frictionless),
      breakaway_N_m_(plan.forces().breakaway_N_m()),
      solver_(plan.arm(), plan.forces(), plan.options().force_tolerance,
              plan.options().most_iterations, !plan.options().resolve_every_mode) {
  const double h = plan.options().sample_time_s;
  const double part = plan.unsettled_part(h);
  summary_.substeps = plan.substeps(plan.arm(), part * h);
  if (part < 1.0) summary_.substeps += plan.substeps(*plan.settled(), (1.0 - part) * h);
  forces_->update(state_);
}

double TimeStepper::hub_angle() const {
  return motion_ == HubMotion::held ? held_angle_rad_ : arm_->hub_angle(state_.x);
}

void TimeStepper::form_force(double actuator_N_m, Eigen::VectorXd& made) const {
  forces_->form({entries(state_.arguments), actuator_N_m, time_s_}, motion_, state_.along_beam,
                made);
}

double TimeStepper::hub_torque_N_m(double actuator_N_m) const {
  return arm_->hub_torque.state.dot(state_.x) + arm_->hub_torque.actuator * actuator_N_m +
         forces_->smooth_torque_N_m(state_.x, actuator_N_m, time_s_);
}

double TimeStepper::reaction(double u) {
  forces_->form({entries(state_.arguments), u, time_s_}, HubMotion::held, state_.along_beam,
                force_);
  return arm_->reaction.state.dot(state_.x) + arm_->reaction.actuator * u +
         arm_->reaction.force.dot(force_);
}

void TimeStepper::take_up(double torque_N_m, double now_s) {
  time_s_ = now_s;
  if (forces_->has_friction() && start_ != Start::inside && torque_N_m != last_torque_N_m_) {
    // It came to a turn at this very instant: what the torque was to do then no longer counts.
    motion_ = HubMotion::held;
    held_angle_rad_ = arm_->hub_angle(state_.x);
    start_ = Start::inside;
  }
  if (motion_ != HubMotion::held) return;
  const double needed = reaction(torque_N_m);
  if (std::abs(needed) <= breakaway_N_m_) return;
  motion_ = turning_like(needed);
  start_ = Start::hub_speed_zero;
  ++summary_.breakaways;
  record_event();
}

void TimeStepper::put(const Eigen::VectorXd& state, bool held) {
  state_.x = state;
  start_ = Start::inside;
  events_at_once_ = 0;
  if (forces_->has_friction()) {
    const double speed = arm_->hub_velocity(state_.x);
    if (held || speed == 0.0) {
      motion_ = HubMotion::held;
      arm_->stop_hub(state_.x);
      held_angle_rad_ = arm_->hub_angle(state_.x);
    } else {
      motion_ = turning_like(speed);
    }
  }
  forces_->update(state_);
}

Eigen::VectorXd TimeStepper::snapshot() const {
  Eigen::VectorXd made(state_.x.size() + kSnapshotNumbers);
  made << state_.x, static_cast<double>(motion_), static_cast<double>(start_), held_angle_rad_,
      last_torque_N_m_, time_s_, static_cast<double>(events_at_once_);
  return made;
}

void TimeStepper::restore(const Eigen::VectorXd& snapshot) {
  const Eigen::Index n = arm_->size();
  if (snapshot.size() != n + kSnapshotNumbers || !snapshot.allFinite()) {
    throw arm::InputError("state: not of this arm");
  }
  const auto whole = [&](Eigen::Index i, int most) {
    const double value = snapshot(n + i);
    if (value != std::floor(value) || value < 0.0 || value > most) {
      throw arm::InputError("state: not of this arm");
    }
    return static_cast<int>(value);
  };
  const int motion = whole(0, static_cast<int>(HubMotion::backward));
  if ((motion == static_cast<int>(HubMotion::frictionless)) == forces_->has_friction()) {
    throw arm::InputError("state: not of this arm");
  }
  state_.x = snapshot.head(n);
  motion_ = static_cast<HubMotion>(motion);
  start_ = static_cast<Start>(whole(1, static_cast<int>(Start::hub_acceleration_zero)));
  held_angle_rad_ = snapshot(n + 2);
  last_torque_N_m_ = snapshot(n + 3);
  time_s_ = snapshot(n + 4);
  events_at_once_ = whole(5, kMostEventsAtOnce + 1);
  solver_.go_on_with(*arm_);
  forces_->update(state_);
}

void TimeStepper::advance(const TorquePiece& piece, double now_s) {
  time_s_ = now_s;
  last_torque_N_m_ = piece.end_N_m;
  if (piece.is_whole_part) {
    const PieceSteps& steps = plan_->regular(piece.part);
    const double between = std::lerp(piece.begin_N_m, piece.end_N_m, steps.unsettled_part);
    advance_in(steps.unsettled, piece.begin_N_m, between);
    if (!steps.settled) return;
    solver_.go_on_with(*plan_->settled());
    advance_in(*steps.settled, between, piece.end_N_m);
    solver_.go_on_with(*arm_);
    return;
  }
  const double length_s = (piece.end - piece.begin) * plan_->options().sample_time_s;
  if (plan_->is_linear() && series_steps(*arm_, length_s) > kMostSeriesSteps) {
    advance_in(plan_->steps(length_s), piece.begin_N_m, piece.end_N_m);
    return;
  }
  const double part = plan_->unsettled_part(length_s);
  const double between = std::lerp(piece.begin_N_m, piece.end_N_m, part);
  advance_by_series(*arm_, part * length_s, piece.begin_N_m, between);
  if (part == 1.0) return;
  solver_.go_on_with(*plan_->settled());
  advance_by_series(*plan_->settled(), (1.0 - part) * length_s, between, piece.end_N_m);
  solver_.go_on_with(*arm_);
}

void TimeStepper::advance_by_series(const ModalDynamics& arm, double length_s, double begin_N_m,
                                    double end_N_m) {
  const int count =
      std::max(plan_->substeps(arm, length_s), static_cast<int>(series_steps(arm, length_s)));
  double u0 = begin_N_m;
  for (int i = 1; i <= count; ++i) {
    const double u1 = torque_behind(i, count, begin_N_m, end_N_m);
    free_step(length_s / count, u0, u1, 0);
    u0 = u1;
  }
}

void TimeStepper::advance_in(const Steps& steps, double begin_N_m, double end_N_m) {
  double u0 = begin_N_m;
  for (int i = 1; i <= steps.count; ++i) {
    const double u1 = torque_behind(i, steps.count, begin_N_m, end_N_m);
    if (plan_->is_linear()) {
      linear_step(steps, u0, u1);
    } else {
      step(steps, u0, u1);
    }
    u0 = u1;
  }
}

void TimeStepper::linear_step(const Steps& steps, double u0, double u1) {
  solver_.solve(steps.turning, state_, motion_, {time_s_, steps.length_s, u0, u1});
  book_whole(steps);
  finish(steps.length_s);
}

void TimeStepper::step(const Steps& steps, double u0, double u1) {
  count_step();
  const StepTable& table = motion_ == HubMotion::held ? steps.held : steps.turning;
  // In a fit friction may change within the shortest of the steps.
  const bool must_be_resolved = steps.shorter || plan_->options().resolve_every_mode;
  const bool is_solved =
      solver_.solve(table, state_, motion_, {time_s_, steps.length_s, u0, u1, must_be_resolved});
  const bool may_happen = is_solved && forces_->has_friction() && !is_quiet(table);
  if (steps.shorter && (!is_solved || may_happen)) {
    if (!is_solved) ++summary_.halved_steps;
    advance_in(*steps.shorter, u0, u1);
    return;
  }
  if (!is_solved) {
    halve(steps.length_s, u0, u1, 0);
    return;
  }
  if (may_happen) {
    solver_.expand(state_.x, motion_);
    if (const std::optional<double> event = next_event()) {
      book(*event);
      const double between = solver_.inputs().torque(*event);
      happen(*event, steps.length_s);
      free_step((1.0 - *event) * steps.length_s, between, u1, 0);
      return;
    }
  }
  book_whole(steps);
  finish(steps.length_s);
}

void TimeStepper::free_step(double length_s, double u0, double u1, int halvings) {
  while (length_s > kNothingLeft * plan_->options().sample_time_s) {
    if (!solver_.solve_by_series(
            state_, motion_, {time_s_, length_s, u0, u1, plan_->options().resolve_every_mode})) {
      halve(length_s, u0, u1, halvings);
      return;
    }
    const bool is_forced = events_at_once_ > kMostEventsAtOnce;
    const std::optional<double> event =
        forces_->has_friction() && !is_forced ? next_event() : std::nullopt;
    book(event.value_or(1.0));
    if (!event) {
      if (is_forced) ++summary_.forced_rests;
      finish(length_s);
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

void TimeStepper::book_whole(const Steps& steps) {
  if (ledger_ == nullptr) return;
  const auto& energy = motion_ == HubMotion::held ? steps.held_energy : steps.turning_energy;
  if (energy) {
    ledger_->add(*energy, solver_.inputs(), motion_, state_.x, solver_.end());
    return;
  }
  solver_.expand(state_.x, motion_);
  book(1.0);
}

void TimeStepper::halve(double length_s, double u0, double u1, int halvings) {
  if (halvings >= kMostHalvings) {
    throw std::runtime_error(fmt::format(
        "simulation: inner step at {} s does not converge at the minimum step size", time_s_));
  }
  ++summary_.halved_steps;
  if (is_too_many(++series_halvings_, plan_->options().most_halved_steps, 1.0)) {
    throw std::runtime_error(
        fmt::format("simulation: {} inner steps halved by {} s", series_halvings_, time_s_));
  }
  const double between = 0.5 * (u0 + u1);
  free_step(0.5 * length_s, u0, between, halvings + 1);
  free_step(0.5 * length_s, between, u1, halvings + 1);
}

void TimeStepper::count_step() {
  if (is_too_many(++steps_, kLeastSteps, plan_->options().most_steps_per_sample)) {
    throw std::runtime_error(fmt::format("simulation: {} inner steps by {} s", steps_, time_s_));
  }
}

/// Than `least`, and than so many for each sample that the run has passed.
bool TimeStepper::is_too_many(std::int64_t steps, std::int64_t least, double per_sample) const {
  return steps > least &&
         static_cast<double>(steps) * plan_->options().sample_time_s > per_sample * time_s_;
}

bool TimeStepper::is_quiet(const StepTable& table) {
  if (start_ != Start::inside) return false;
  // The bound contains the value at the end: where that has left already, it need not be computed.
  if (motion_ != HubMotion::held && direction(motion_) * arm_->hub_velocity(solver_.end()) <= 0.0) {
    return false;
  }
  const auto [least, largest] =
      table.watched(state_.x, solver_.end(), solver_.inputs(), workspace_);
  if (motion_ == HubMotion::held) return least > -breakaway_N_m_ && largest < breakaway_N_m_;
  return motion_ == HubMotion::forward ? least > 0.0 : largest < 0.0;
}

std::optional<double> TimeStepper::next_event() const {
  if (motion_ != HubMotion::held) {
    const Eigen::RowVectorXd speed =
        direction(motion_) * solver_.series().of(plan_->velocity_row());
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
  state_.x = solver_.series().at(r);
  arm_->stop_hub(state_.x);
  time_s_ += passed_s;
  ++summary_.inner_steps;
  if (was_held) {
    summary_.stick_time_s += passed_s;
    arm_->set_hub_angle(state_.x, held_angle_rad_);
  }
  forces_->update(state_);
  events_at_once_ = r > kInstant ? 0 : events_at_once_ + 1;
  const double needed = reaction(u);
  if (was_held && events_at_once_ <= kMostEventsAtOnce) {
    motion_ = turning_like(needed);
    start_ = Start::hub_acceleration_zero;
    ++summary_.breakaways;
  } else if (std::abs(needed) <= breakaway_N_m_ || events_at_once_ > kMostEventsAtOnce) {
    motion_ = HubMotion::held;
    start_ = Start::inside;
    held_angle_rad_ = arm_->hub_angle(state_.x);
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

void TimeStepper::finish(double duration_s) {
  state_.x = solver_.end();
  if (motion_ == HubMotion::held) {
    arm_->stop_hub(state_.x);
    arm_->set_hub_angle(state_.x, held_angle_rad_);
    summary_.stick_time_s += duration_s;
  }
  forces_->form_arguments(state_.x, state_.arguments);
  state_.along_beam = solver_.along_beam();  // within the tolerance of the step
  start_ = Start::inside;
  events_at_once_ = 0;
  time_s_ += duration_s;
  ++summary_.inner_steps;
}

}  // namespace flexarm::response
