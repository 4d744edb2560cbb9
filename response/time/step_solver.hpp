#pragma once

#include "response/time/added_forces.hpp"
#include "response/time/expansion.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/step_table.hpp"

#include <Eigen/Core>

#include <array>

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
class StepSolver {
 public:
  /// `arm` and `forces` must outlive the object. An iteration has converged when no force changes
  /// by more than `force_tolerance` times the largest.
  StepSolver(const ModalDynamics& arm, const AddedForces& forces, double force_tolerance,
             int most_iterations);

  /// Goes on with the equations of `arm`, which must outlive the object: the same arm before or
  /// after Z has settled.
  void go_on_with(const ModalDynamics& arm) {
    arm_ = &arm;
    last_length_s_ = 0.0;
  }
  /// A step from `x` of the table's length; false where forces do not converge, or friction falls
  /// too much over it: halve it then. Leaves end() and inputs(), not series().
  bool solve(const StepTable& table, const Eigen::VectorXd& x, HubMotion motion,
             const StepSpan& span);
  /// A step of any length. Leaves series() and inputs(), not end().
  bool solve_by_series(const Eigen::VectorXd& x, HubMotion motion, const StepSpan& span);
  /// Forms series() for the step that `solve` has solved.
  void expand(const Eigen::VectorXd& x, HubMotion motion);

  const Eigen::VectorXd& end() const { return end_; }
  const Expansion& series() const { return series_; }
  const StepInputs& inputs() const { return inputs_; }
  int most_iterations() const { return iterations_; }

 private:
  void begin(const Eigen::VectorXd& x, HubMotion motion, const StepSpan& span, bool follows);
  bool is_resolved(const Eigen::VectorXd& begin, const Eigen::VectorXd& end,
                   HubMotion motion) const;
  bool improve(const Eigen::VectorXd& middle, const Eigen::VectorXd& end, HubMotion motion);

  const ModalDynamics* arm_;
  const AddedForces* forces_;
  double force_tolerance_;
  int allowed_iterations_;
  int iterations_ = 0;
  StepInputs inputs_;
  std::array<double, 3> hub_torques_ = {};  // in inputs_: begin, middle, end
  HubMotion last_motion_ = HubMotion::frictionless;
  double last_length_s_ = 0.0;  // 0: inputs_ are no guess for the next step
  Eigen::VectorXd middle_;
  Eigen::VectorXd end_;
  Expansion series_;
};

}  // namespace flexarm::response
