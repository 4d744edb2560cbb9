#pragma once

#include "response/added_forces.hpp"
#include "response/energy_ledger.hpp"
#include "response/expansion.hpp"
#include "response/modal_dynamics.hpp"
#include "response/simulation.hpp"
#include "response/step_table.hpp"
#include "response/torque_path.hpp"

#include <array>
#include <optional>
#include <span>

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
/// Varying forces f(X) are solved by exponential collocation: f is the parabola through its values
/// at begin, middle and end of the step (Lobatto's points), X(r) the exact solution for that
/// parabola, of order 4 in the step. Unknown are f at middle and end; friction is iterated by
/// Newton's method with the mobility of the hub alone, drag and ripple, which are soft, by
/// substitution.
class TimeStepper {
 public:
  /// `forces` and `arm` must outlive the object. The hub is at rest.
  TimeStepper(const ModalDynamics& arm, const AddedForces& forces, bool has_friction,
              const TorquePath& path, const SimulationOptions& options, EnergyLedger* ledger);

  /// Takes up the torque behind a sample or a break: a hub at rest may be pulled loose.
  void take_up(double torque_N_m, double now_s);
  /// One piece, which begins now.
  void advance(const TorquePiece& piece, double now_s);

  const Eigen::VectorXd& state() const { return x_; }
  HubMotion motion() const { return motion_; }
  double hub_angle() const;
  /// Added forces at the present state, m.
  Eigen::VectorXd force() const;
  /// T, without friction.
  double hub_torque_N_m(double actuator_N_m) const;
  const LinearSystem& system() const {
    return motion_ == HubMotion::held ? arm_->held : arm_->turning;
  }
  SimulationSummary& summary() { return summary_; }

 private:
  /// Inner steps of one length.
  struct Steps {
    int count = 0;
    double length_s = 0.0;
    StepTable turning;
    StepTable held;
  };
  /// What is known of the solution at the beginning of a step.
  enum class Start { inside, hub_speed_zero, hub_acceleration_zero };

  Steps steps(double length_s) const;
  int substeps(double length_s) const;
  void step(const Steps& steps, double u0, double u1);
  void free_step(double length_s, double u0, double u1, int halvings);
  void halve(double length_s, double u0, double u1, int halvings);
  bool solve(const StepTable& table, double length_s);
  bool solve_by_series(double length_s);
  bool improve(const Eigen::VectorXd& middle, const Eigen::VectorXd& end, double length_s);
  void begin_forces(double u0, double u1);
  void expand(double length_s);
  bool is_quiet(const StepTable& table, const Eigen::VectorXd& end) const;
  std::optional<double> next_event() const;
  double reaction(const Eigen::VectorXd& x, double u) const;
  void happen(double r, double length_s);
  void record_event();
  void finish(const Eigen::VectorXd& end, double duration_s);

  const ModalDynamics* arm_;
  const AddedForces* forces_;
  SimulationOptions options_;
  EnergyLedger* ledger_;
  bool has_friction_;
  std::array<Steps, 3> regular_;  // by TorquePiece::Length

  Eigen::RowVectorXd velocity_row_;  // theta' = velocity_row_ X
  Eigen::VectorXd x_;
  Eigen::VectorXd next_;
  Eigen::VectorXd middle_;
  HubMotion motion_;
  Start start_ = Start::inside;
  double held_angle_rad_ = 0.0;
  double breakaway_N_m_ = 0.0;
  double time_s_ = 0.0;
  StepInputs inputs_;
  std::array<double, 3> hub_torques_ = {};  // of AddedForces, in inputs_: begin, middle, end
  bool guess_ = false;  // inputs_ are those of the step before, of the same length and motion
  Expansion solution_;
  int events_at_once_ = 0;
  SimulationSummary summary_;
};

}  // namespace flexarm::response
