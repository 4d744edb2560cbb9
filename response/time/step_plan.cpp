#include "response/time/step_plan.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flexarm::response {

namespace {

/// |A| dt of a step where forces vary, so that the parabola through them resolves every mode: its
/// error is of order 4 in this.
constexpr double kLargestPhaseVarying_rad = 0.5;
/// Time constants after which Z has settled: e^-40 = 4e-18 of what it was.
constexpr double kSettling = 40.0;
/// A piece is divided where Z settles within this part of it.
constexpr double kLargestUnsettledPart = 0.5;

}  // namespace

StepPlan::StepPlan(const ModalDynamics& arm, const AddedForces& forces, const Actuator& actuator,
                   const SimulationOptions& options, const EnergyLedger* ledger,
                   std::span<const double> cuts)
    : arm_(&arm),
      forces_(&forces),
      options_(options),
      ledger_(ledger),
      is_linear_(!forces.has_friction() && !forces.vary()),
      velocity_row_(Eigen::RowVectorXd::Zero(arm.size())),
      argument_rows_(forces.argument_rows()),
      settling_s_(kSettling * actuator.lag_s) {
  velocity_row_.segment(arm.modes, arm.modes) = arm.hub_slope.transpose();
  if (!is_linear_ && arm.lagged_torque) settled_ = with_settled_torque(arm);
  if (forces.has_friction()) {
    watched_ = watched_readings(arm);
    if (settled_) settled_watched_ = watched_readings(*settled_);
  }
  const double h = options.sample_time_s;
  const std::vector<double> edges = TorquePath(actuator, {}, h, options.hold, cuts).edges();
  for (std::size_t part = 0; part + 1 < edges.size(); ++part) {
    regular_.push_back(piece_steps((edges[part + 1] - edges[part]) * h));
  }
}

double StepPlan::unsettled_part(double length_s) const {
  const bool is_short = settled_ && settling_s_ <= kLargestUnsettledPart * length_s;
  return is_short ? settling_s_ / length_s : 1.0;
}

int StepPlan::substeps(const ModalDynamics& arm, double length_s) const {
  const double h = options_.sample_time_s;
  const bool as_asked = forces_->vary() || options_.resolve_every_mode;
  double count = as_asked ? std::ceil(options_.substeps * length_s / h - 1e-9) : 1.0;
  double largest_phase = std::numeric_limits<double>::infinity();
  if (ledger_ != nullptr) largest_phase = kLargestPhase_rad;
  // In a fit the steps that need it are halved.
  if (forces_->vary() && options_.resolve_every_mode) largest_phase = kLargestPhaseVarying_rad;
  double most = count;  // steps as short as events may need
  if (!is_linear_) most = std::max(count, std::ceil(phase_rad(arm, length_s) / largest_phase));
  if (!(most <= kMostSubsteps)) {
    throw arm::InputError(fmt::format(
        "effects.{}: needs {:g} inner steps per sample of {} s (fastest rate {:g} rad/s), at most "
        "{}: reduce the damping or the sampling period",
        forces_->effect_in_steps(), most, h, arm.fastest_rate_rad_per_s, kMostSubsteps));
  }
  if (forces_->vary()) count = most;
  return std::max(1, static_cast<int>(count));
}

StepPlan::WatchedReadings StepPlan::watched_readings(const ModalDynamics& arm) const {
  const Reading speed = {velocity_row_, 0.0, Eigen::RowVectorXd::Zero(arm.turning.force.cols())};
  return {std::make_shared<const ReadingModes>(arm, false, speed),
          std::make_shared<const ReadingModes>(arm, true, arm.reaction)};
}

Steps StepPlan::steps(const ModalDynamics& arm, double length_s) const {
  const int count = substeps(arm, length_s);
  const double step_s = length_s / count;
  const WatchedReadings& watched = &arm == arm_ ? watched_ : settled_watched_;
  int halvings = 0;
  while (!is_linear_ &&
         phase_rad(arm, std::ldexp(step_s, -halvings)) > kLargestPhase_rad * (1.0 + 1e-9)) {
    ++halvings;
  }
  const auto propagators = [&](const LinearSystem& system) {
    return halved_propagators(system, step_s, halvings, argument_rows_.rows() > 0,
                              options_.precision);
  };
  const auto turning = propagators(arm.turning);
  const auto held =
      forces_->has_friction() ? propagators(arm.held) : std::vector<StepPropagators>();
  Steps made;
  for (int level = halvings; level >= 0; --level) {
    const auto at = static_cast<std::size_t>(level);
    if (level < halvings) made = {.shorter = std::make_shared<const Steps>(std::move(made))};
    made.count = level > 0 ? 2 : count;
    made.length_s = std::ldexp(step_s, -level);
    made.turning = step_table(turning[at], argument_rows_, watched.speed, made.length_s);
    if (!held.empty()) {
      made.held = step_table(held[at], argument_rows_, watched.reaction, made.length_s);
    }
    if (ledger_ == nullptr || forces_->vary()) continue;
    using Hub = StepEnergy::Hub;
    made.turning_energy = ledger_->step_energy(arm, Hub::turning, made.length_s);
    if (!held.empty()) made.held_energy = ledger_->step_energy(arm, Hub::held, made.length_s);
  }
  return made;
}

PieceSteps StepPlan::piece_steps(double length_s) const {
  PieceSteps made{.unsettled_part = unsettled_part(length_s)};
  made.unsettled = steps(*arm_, made.unsettled_part * length_s);
  if (made.unsettled_part < 1.0) {
    made.settled = steps(*settled_, (1.0 - made.unsettled_part) * length_s);
  }
  return made;
}

}  // namespace flexarm::response
