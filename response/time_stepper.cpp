#include "response/time_stepper.hpp"

#include "arm/input_error.hpp"
#include "response/first_crossing.hpp"

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

HubMotion turning_like(double torque) {
  return torque > 0.0 ? HubMotion::forward : HubMotion::backward;
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
      x_(Eigen::VectorXd::Zero(arm.size())),
      next_(arm.size()),
      middle_(arm.size()),
      motion_(has_friction ? HubMotion::held : HubMotion::frictionless),
      breakaway_N_m_(forces.breakaway_N_m()) {
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
  if (has_friction_ || ledger_ != nullptr || forces_->vary()) {
    const double phase = forces_->vary() ? kLargestPhaseVarying_rad : kLargestPhase_rad;
    count = std::max(count, std::ceil(arm_->fastest_rate_rad_per_s * length_s / phase));
  }
  if (!(count <= kMostSubsteps)) {
    throw arm::InputError(
        fmt::format("sample time = {} s: {:g} inner steps a sample are needed for a rate of {:g} "
                    "rad/s: must be "
                    "{} or fewer",
                    h, count, arm_->fastest_rate_rad_per_s, kMostSubsteps));
  }
  return std::max(1, static_cast<int>(count));
}

TimeStepper::Steps TimeStepper::steps(double length_s) const {
  Steps made;
  made.count = substeps(length_s);
  made.length_s = length_s / made.count;
  const Reading speed = {velocity_row_, 0.0, Eigen::RowVectorXd::Zero(arm_->turning.force.cols())};
  made.turning = step_table(arm_->turning, speed, made.length_s, forces_->vary());
  if (has_friction_) {
    made.held = step_table(arm_->held, arm_->reaction, made.length_s, forces_->vary());
  }
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
  if (motion_ != HubMotion::held) return;
  const double needed = reaction(x_, torque_N_m);
  if (std::abs(needed) <= breakaway_N_m_) return;
  motion_ = turning_like(needed);
  start_ = Start::hub_speed_zero;
  guess_ = false;
  ++summary_.breakaways;
  record_event();
}

void TimeStepper::advance(const TorquePiece& piece, double now_s) {
  const double h = options_.sample_time_s;
  time_s_ = now_s;
  const double change = piece.end_N_m - piece.begin_N_m;
  const bool is_regular = piece.length != TorquePiece::Length::other;
  const double length_s = (piece.end - piece.begin) * h;
  const Steps* regular = is_regular ? &regular_[static_cast<std::size_t>(piece.length)] : nullptr;
  const int count =
      is_regular
          ? regular->count
          : std::max(substeps(length_s), static_cast<int>(std::ceil(arm_->fastest_rate_rad_per_s *
                                                                    length_s / kLargestPhase_rad)));
  double u0 = piece.begin_N_m;
  for (int i = 1; i <= count; ++i) {
    const double u1 = i == count ? piece.end_N_m : piece.begin_N_m + change * i / count;
    if (is_regular) {
      step(*regular, u0, u1);
    } else {
      guess_ = false;
      free_step(length_s / count, u0, u1, 0);
    }
    u0 = u1;
  }
}

/// f at the begin of a step; where forces are constant, all of f.
void TimeStepper::begin_forces(double u0, double u1) {
  inputs_.u0 = u0;
  inputs_.u1 = u1;
  const double torque = forces_->hub_torque(x_, motion_).torque_N_m;
  if (!forces_->vary()) {
    inputs_.f0.setConstant(1, torque);
    inputs_.fm.setConstant(1, torque);
    inputs_.f1.setConstant(1, torque);
    return;
  }
  if (guess_) {  // the last step's parabola at r = 3/2 and r = 2
    const Eigen::VectorXd middle = inputs_.f0 - 3.0 * inputs_.fm + 3.0 * inputs_.f1;
    inputs_.f1 = 3.0 * inputs_.f0 - 8.0 * inputs_.fm + 6.0 * inputs_.f1;
    inputs_.fm = middle;
    const double hub_middle = hub_torques_[0] - 3.0 * hub_torques_[1] + 3.0 * hub_torques_[2];
    hub_torques_[2] = 3.0 * hub_torques_[0] - 8.0 * hub_torques_[1] + 6.0 * hub_torques_[2];
    hub_torques_[1] = hub_middle;
    inputs_.f0 = forces_->force(x_, torque);
    hub_torques_[0] = torque;
  } else {
    inputs_.f0 = forces_->force(x_, torque);
    inputs_.fm = inputs_.f0;
    inputs_.f1 = inputs_.f0;
    hub_torques_.fill(torque);
  }
}

void TimeStepper::step(const Steps& steps, double u0, double u1) {
  const StepTable& table = motion_ == HubMotion::held ? steps.held : steps.turning;
  begin_forces(u0, u1);
  if (!forces_->vary()) {
    next_.noalias() = table.end.state * x_;
    next_ += table.end.actuator_begin * u0 + table.end.actuator_end * u1 +
             table.constant * inputs_.f0(0);
  } else if (!solve(table, steps.length_s)) {
    halve(steps.length_s, u0, u1, 0);
    return;
  }
  const bool may_happen = has_friction_ && !is_quiet(table, next_);
  if (may_happen || ledger_ != nullptr) {
    expand(steps.length_s);
    const std::optional<double> event = may_happen ? next_event() : std::nullopt;
    if (ledger_ != nullptr) ledger_->add(solution_, inputs_, motion_, event.value_or(1.0));
    if (event) {
      const double between = inputs_.torque(*event);
      happen(*event, steps.length_s);
      free_step((1.0 - *event) * steps.length_s, between, u1, 0);
      return;
    }
  }
  finish(next_, steps.length_s);
  guess_ = true;
}

void TimeStepper::free_step(double length_s, double u0, double u1, int halvings) {
  while (length_s > kNothingLeft * options_.sample_time_s) {
    guess_ = false;
    begin_forces(u0, u1);
    if (!forces_->vary()) {
      expand(length_s);
    } else if (!solve_by_series(length_s)) {
      halve(length_s, u0, u1, halvings);
      return;
    }
    const bool is_forced = events_at_once_ > kMostEventsAtOnce;
    const std::optional<double> event = has_friction_ && !is_forced ? next_event() : std::nullopt;
    if (ledger_ != nullptr) ledger_->add(solution_, inputs_, motion_, event.value_or(1.0));
    if (!event) {
      if (is_forced) ++summary_.forced_rests;
      finish(solution_.at(1.0), length_s);
      return;
    }
    u0 = inputs_.torque(*event);
    happen(*event, length_s);
    length_s *= 1.0 - *event;
  }
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

bool TimeStepper::solve(const StepTable& table, double length_s) {
  const auto base = [this](const Propagator& to) -> Eigen::VectorXd {
    return to.state * x_ + to.actuator_begin * inputs_.u0 + to.actuator_end * inputs_.u1 +
           to.force_begin * inputs_.f0;
  };
  const Eigen::VectorXd base_middle = base(table.middle);
  const Eigen::VectorXd base_end = base(table.end);
  for (int iteration = 1; iteration <= options_.most_iterations; ++iteration) {
    middle_ = base_middle;
    middle_ += table.middle.force_middle * inputs_.fm + table.middle.force_end * inputs_.f1;
    next_ = base_end;
    next_ += table.end.force_middle * inputs_.fm + table.end.force_end * inputs_.f1;
    summary_.most_iterations = std::max(summary_.most_iterations, iteration);
    if (improve(middle_, next_, length_s)) return true;
  }
  return false;
}

bool TimeStepper::solve_by_series(double length_s) {
  for (int iteration = 1; iteration <= options_.most_iterations; ++iteration) {
    expand(length_s);
    summary_.most_iterations = std::max(summary_.most_iterations, iteration);
    if (improve(solution_.at(0.5), solution_.at(1.0), length_s)) return true;
  }
  return false;
}

/// True when f at these states is the f they were solved with. Else takes f from them, hub torque N
/// by a Newton step: with the mobility mu of the hub, N changes its speed by Lobatto's weights,
///
///     d theta'(1/2) = mu dt (dNm/3 - dN1/24),   d theta'(1) = mu dt (2 dNm/3 + dN1/6).
bool TimeStepper::improve(const Eigen::VectorXd& middle, const Eigen::VectorXd& end,
                          double length_s) {
  const auto hub_middle = forces_->hub_torque(middle, motion_);
  const auto hub_end = forces_->hub_torque(end, motion_);
  const Eigen::VectorXd fm = forces_->force(middle, hub_middle.torque_N_m);
  const Eigen::VectorXd f1 = forces_->force(end, hub_end.torque_N_m);
  const auto largest = [](const Eigen::VectorXd& v) { return v.cwiseAbs().maxCoeff(); };
  const double change = std::max(largest(fm - inputs_.fm), largest(f1 - inputs_.f1));
  const double size = std::max({largest(inputs_.f0), largest(fm), largest(f1)});
  if (change <= options_.force_tolerance * size) return true;

  const double rm = hub_middle.torque_N_m - hub_torques_[1];
  const double r1 = hub_end.torque_N_m - hub_torques_[2];
  const double mu_dt = length_s * arm_->hub_slope.squaredNorm() / arm_->modal_mass_kg_m2;
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

void TimeStepper::expand(double length_s) {
  const LinearSystem& now = system();
  std::array<Eigen::VectorXd, 3> inputs;
  inputs[0] = now.actuator * inputs_.u0 + now.force * inputs_.f0;
  inputs[1] = now.actuator * (inputs_.u1 - inputs_.u0) + now.force * inputs_.force_slope();
  inputs[2] = now.force * inputs_.force_square();
  solution_.compute(now.a, length_s, x_, inputs);
}

bool TimeStepper::is_quiet(const StepTable& table, const Eigen::VectorXd& end) const {
  if (start_ != Start::inside) return false;
  const double sag =
      forces_->vary()
          ? table.sag(x_, inputs_)
          : table.sag.of_constant(x_, std::max(std::abs(inputs_.u0), std::abs(inputs_.u1)),
                                  std::abs(inputs_.u1 - inputs_.u0), std::abs(inputs_.f0(0)));
  if (motion_ == HubMotion::held) {
    const double most =
        std::max(std::abs(reaction(x_, inputs_.u0)), std::abs(reaction(end, inputs_.u1)));
    return most + sag < breakaway_N_m_;
  }
  const double sign = direction(motion_);
  return std::min(sign * arm_->hub_velocity(x_), sign * arm_->hub_velocity(end)) > sag;
}

std::optional<double> TimeStepper::next_event() const {
  if (motion_ != HubMotion::held) {
    const Eigen::RowVectorXd speed = direction(motion_) * solution_.of(velocity_row_);
    // Known zeros at r = 0 are divided out.
    const std::size_t zeros = start_ == Start::inside ? 0 : start_ == Start::hub_speed_zero ? 1 : 2;
    return first_crossing(as_span(speed).subspan(zeros));
  }
  Eigen::RowVectorXd needed = solution_.of(arm_->reaction.state);
  needed(0) += arm_->reaction.actuator * inputs_.u0 + arm_->reaction.force.dot(inputs_.f0);
  needed(1) += arm_->reaction.actuator * (inputs_.u1 - inputs_.u0) +
               arm_->reaction.force.dot(inputs_.force_slope());
  needed(2) += arm_->reaction.force.dot(inputs_.force_square());
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
  const double u = inputs_.torque(r);
  const bool was_held = motion_ == HubMotion::held;
  x_ = solution_.at(r);
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
