#pragma once

#include "response/time/added_forces.hpp"
#include "response/time/expansion.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/step_inputs.hpp"
#include "response/time/step_table.hpp"

#include <Eigen/Core>

#include <array>
#include <span>

namespace flexarm::response {

/// When an inner step is, and the actuator's torque at its ends.
struct StepSpan {
  double begin_s = 0.0;
  double length_s = 0.0;
  double u0 = 0.0;
  double u1 = 0.0;
  /// The step fails where friction changes too much over it for a parabola.
  bool must_be_resolved = true;
};

/// Solves one inner step, the hub moving one way all the time.
///
/// Constant forces: exactly. Varying forces f(X): by exponential collocation. f is the parabola
/// through its values at begin, middle and end of the step (Lobatto's points), X(r) the exact
/// solution for that parabola; of order 4 in the step. Unknown are f at middle and end; friction is
/// iterated by Newton's method with the mobility of the hub alone, what is soft, by substitution.
/// Of the states at middle and end an iteration forms what forces depend on, and no more.
class StepSolver {
 public:
  /// `arm` and `forces` must outlive the object. Forces are found when none changes by more than
  /// `force_tolerance` times the largest, or when the next iteration would change none by a tenth
  /// of that, at the slowest rate of convergence of this step and the one before.
  StepSolver(const ModalDynamics& arm, const AddedForces& forces, double force_tolerance,
             int most_iterations);

  /// Goes on with the equations of `arm`, which must outlive the object: the same arm before or
  /// after Z has settled.
  void go_on_with(const ModalDynamics& arm) {
    arm_ = &arm;
    last_length_s_ = 0.0;
  }
  /// A step from `now` of the table's length; false where forces do not converge, or friction falls
  /// too much over it: halve it then. Leaves inputs(), end() and along_beam(), not series().
  bool solve(const StepTable& table, const ArmState& now, HubMotion motion, const StepSpan& span);
  /// A step of any length. Leaves series() besides.
  bool solve_by_series(const ArmState& now, HubMotion motion, const StepSpan& span);
  /// Forms series() for the step that `solve` has solved from `x`.
  void expand(const Eigen::VectorXd& x, HubMotion motion);

  /// X at the end.
  const Eigen::VectorXd& end() const { return end_; }
  /// Forces along the beam at the end; empty without.
  const Eigen::VectorXd& along_beam() const { return end_point_.along_beam; }
  const Expansion& series() const { return series_; }
  const StepInputs& inputs() const { return inputs_; }
  int most_iterations() const { return iterations_; }

 private:
  /// Forces at the middle or the end, of the arguments that the last ones lead to.
  struct Point {
    Eigen::VectorXd along_beam;
    Eigen::VectorXd force;
    AddedForces::HubTorque hub;
  };

  void begin(const ArmState& now, HubMotion motion, const StepSpan& span, bool follows);
  void start(const StepTable& table, const Eigen::VectorXd& x);
  bool is_resolved(double begin_rad_per_s, double end_rad_per_s, HubMotion motion,
                   double largest_change) const;
  void evaluate(std::span<const double> arguments, double r, HubMotion motion, Point& point) const;
  double relative_change() const;
  void improve();

  const ModalDynamics* arm_;
  const AddedForces* forces_;
  double force_tolerance_;
  int allowed_iterations_;
  int iterations_ = 0;
  StepInputs inputs_;
  std::array<double, 3> hub_torques_ = {};  // in inputs_: begin, middle, end
  HubMotion last_motion_ = HubMotion::frictionless;
  double last_slowest_ = 0.0;   // of the ratios of an iteration's change to the one before
  double last_length_s_ = 0.0;  // 0: inputs_ are no guess for the next step
  Eigen::VectorXd known_;       // StepTable's columns: X; u0; u1; T or f0, fm, f1
  Eigen::VectorXd known_arguments_;
  Eigen::VectorXd arguments_;  // middle; end
  Point middle_point_;
  Point end_point_;
  Eigen::VectorXd middle_;
  Eigen::VectorXd end_;
  Expansion series_;
};

}  // namespace flexarm::response
