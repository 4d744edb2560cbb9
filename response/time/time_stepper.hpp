#pragma once

#include "response/time/energy_ledger.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/simulation.hpp"
#include "response/time/step_plan.hpp"
#include "response/time/step_solver.hpp"
#include "response/time/torque_path.hpp"

#include <cstdint>
#include <optional>

namespace flexarm::response {

/// The arm's motion, piece of torque by piece of torque.
///
/// While the hub turns one way, and while friction holds it, the equations are smooth: linear with
/// constant friction, else with forces that vary with the state. Each inner step solves one of
/// these two systems; where the solution leaves it, the step ends there and the next begins with
/// the other:
///
///     turning, theta' reaches 0:  held where the torque R that keeps the hub at rest is within
///                                 +-breakaway, else turning in R's direction;
///     held, R leaves +-breakaway: turning in R's direction.
///
/// This is Filippov's solution. R is continuous between jumps of the torque, and a reversal needs
/// |R| above breakaway with the other sign: reversals cannot pile up. Nor can rests and breakaways,
/// since R is analytic between jumps. Only rounding could make them, where |R| just touches
/// breakaway; then the hub is held for the rest of the inner step.
///
/// A linear arm needs no inner steps: a step is exact however fast its motions decay.
/// StepPlan says how long the steps of other arms are.
class TimeStepper {
 public:
  /// `plan` and `ledger`, which may be null, must outlive the object. The hub is at rest.
  TimeStepper(const StepPlan& plan, EnergyLedger* ledger);

  /// Takes up the torque behind a sample or a break: a hub at rest may be pulled loose.
  void take_up(double torque_N_m, double now_s);
  /// One piece, which begins now.
  void advance(const TorquePiece& piece, double now_s);

  /// Goes on from another state; where there is friction the hub is held there with `held`, else it
  /// turns as its speed says.
  void put(const Eigen::VectorXd& state, bool held);

  /// Numbers of a snapshot: those of the state, and these.
  static constexpr Eigen::Index kSnapshotNumbers = 6;
  /// What the motion goes on from. Where forces vary, what the solver has learned of them is not
  /// part of it: the motion goes on within their tolerance.
  Eigen::VectorXd snapshot() const;
  /// Goes on from a snapshot of a stepper with the same plan. Throws InputError for one of another
  /// size, and for numbers that are none.
  void restore(const Eigen::VectorXd& snapshot);

  const Eigen::VectorXd& state() const { return state_.x; }
  HubMotion motion() const { return motion_; }
  double hub_angle() const;
  /// Writes the added forces, LinearSystem's f, at the present state with that torque of the
  /// actuator to `made`: m entries.
  void form_force(double actuator_N_m, Eigen::VectorXd& made) const;
  /// T, without friction.
  double hub_torque_N_m(double actuator_N_m) const;
  const LinearSystem& system() const {
    return motion_ == HubMotion::held ? arm_->held : arm_->turning;
  }
  const SimulationSummary& summary() const { return summary_; }
  /// Of the summary, their times: of a motion without end they would fill the memory.
  void forget_event_times() { summary_.event_times_s.clear(); }
  int most_iterations() const { return solver_.most_iterations(); }

 private:
  /// What is known of the solution at the beginning of a step.
  enum class Start { inside, hub_speed_zero, hub_acceleration_zero };

  void advance_in(const Steps& steps, double begin_N_m, double end_N_m);
  void advance_by_series(const ModalDynamics& arm, double length_s, double begin_N_m,
                         double end_N_m);
  void step(const Steps& steps, double u0, double u1);
  void linear_step(const Steps& steps, double u0, double u1);
  void free_step(double length_s, double u0, double u1, int halvings);
  void halve(double length_s, double u0, double u1, int halvings);
  void count_step();
  bool is_too_many(std::int64_t steps, std::int64_t least, double per_sample) const;
  void book(double until);
  void book_whole(const Steps& steps);
  bool is_quiet(const StepTable& table);
  std::optional<double> next_event() const;
  double reaction(double u);
  void happen(double r, double length_s);
  void record_event();
  void finish(double duration_s);

  const StepPlan* plan_;
  const ModalDynamics* arm_;
  const AddedForces* forces_;
  EnergyLedger* ledger_;
  ArmState state_;
  Eigen::VectorXd force_;  // of the last reaction
  HubMotion motion_;
  Start start_ = Start::inside;
  double held_angle_rad_ = 0.0;
  double breakaway_N_m_ = 0.0;
  double last_torque_N_m_ = 0.0;  // at the end of the last piece
  double time_s_ = 0.0;
  StepSolver solver_;
  ReadingBound::Workspace workspace_;
  int events_at_once_ = 0;
  std::int64_t steps_ = 0;  // inner steps, those that were halved among them
  std::int64_t series_halvings_ = 0;
  SimulationSummary summary_;
};

}  // namespace flexarm::response
