#pragma once

#include "response/time/added_forces.hpp"
#include "response/time/energy_ledger.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/simulation.hpp"
#include "response/time/step_solver.hpp"
#include "response/time/step_table.hpp"
#include "response/time/torque_path.hpp"

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
/// A linear arm needs no inner steps: a step is exact however fast its motions decay.
class TimeStepper {
 public:
  /// `forces` and `arm` must outlive the object. The hub is at rest.
  TimeStepper(const ModalDynamics& arm, const AddedForces& forces, bool has_friction,
              const TorquePath& path, const SimulationOptions& options, EnergyLedger* ledger);

  /// Takes up the torque behind a sample or a break: a hub at rest may be pulled loose.
  void take_up(double torque_N_m, double now_s);
  /// One piece, which begins now.
  void advance(const TorquePiece& piece, double now_s);

  /// Goes on from another state; where there is friction the hub is held there with `held`, else it
  /// turns as its speed says.
  void put(const Eigen::VectorXd& state, bool held);

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
  const SimulationSummary& summary() const { return summary_; }
  int most_iterations() const { return solver_.most_iterations(); }

 private:
  /// Inner steps of one length.
  struct Steps {
    int count = 0;
    double length_s = 0.0;
    StepTable turning;
    StepTable held;
    std::optional<StepEnergy> energy;  ///< of a linear arm whose energy is booked
  };
  /// What is known of the solution at the beginning of a step.
  enum class Start { inside, hub_speed_zero, hub_acceleration_zero };

  Steps steps(double length_s) const;
  int substeps(double length_s) const;
  void advance_in(const Steps& steps, const TorquePiece& piece);
  void step(const Steps& steps, double u0, double u1);
  void linear_step(const Steps& steps, double u0, double u1);
  void free_step(double length_s, double u0, double u1, int halvings);
  void halve(double length_s, double u0, double u1, int halvings);
  void book(double until);
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
  bool is_linear_;
  std::array<Steps, 3> regular_;  // by TorquePiece::Length

  Eigen::RowVectorXd velocity_row_;  // theta' = velocity_row_ X
  Eigen::VectorXd x_;
  HubMotion motion_;
  Start start_ = Start::inside;
  double held_angle_rad_ = 0.0;
  double breakaway_N_m_ = 0.0;
  double last_torque_N_m_ = 0.0;  // at the end of the last piece
  double time_s_ = 0.0;
  StepSolver solver_;
  int events_at_once_ = 0;
  SimulationSummary summary_;
};

}  // namespace flexarm::response
