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
/// An iteration does not form the states at middle and end, but the arguments of the forces there
/// (AddedForces).
class StepSolver {
 public:
  /// `arm` and `forces` must outlive the object. With the tolerance t an iteration that changes the
  /// forces at middle and end by d, the largest change relative to the largest force, is the last
  /// where
  ///
  ///     d <= t,   or from the second one on   d q <= t/10.
  ///
  /// q estimates the rate of convergence: the largest ratio of d to that of the iteration before,
  /// in this step and in the last one that `solve` iterated more than once. d q is about the next
  /// iteration's d. A step by series ends with d <= t alone.
  ///
  /// With `turns_states` states of laws that move with the hub's angle alone are not integrated
  /// while the hub turns one way, but formed at middle and end by AddedForces::turn_states: a step
  /// resolves what they do, not their rates.
  StepSolver(const ModalDynamics& arm, const AddedForces& forces, double force_tolerance,
             int most_iterations, bool turns_states);

  /// Goes on with the equations of `arm`, which must outlive the object: the same arm before or
  /// after Z has settled.
  void go_on_with(const ModalDynamics& arm) {
    arm_ = &arm;
    last_length_s_ = 0.0;
  }
  /// A step from `now` of the table's length; false where forces do not converge, or friction falls
  /// too much over it: halve it then. Sets inputs(), end() and along_beam(), not series().
  bool solve(const StepTable& table, const ArmState& now, HubMotion motion, const StepSpan& span);
  /// The same for a step of any length. Sets series(), too.
  bool solve_by_series(const ArmState& now, HubMotion motion, const StepSpan& span);
  /// Forms series() for the step that `solve` has solved from `x`.
  void expand(const Eigen::VectorXd& x, HubMotion motion);

  /// X at the end, N.
  const Eigen::VectorXd& end() const { return end_; }
  /// Modal forces along the beam at the end [1/s^2], n, of the last iteration: they differ from
  /// those of end() within the tolerance. Empty without such forces.
  const Eigen::VectorXd& along_beam() const { return end_point_.along_beam; }
  const Expansion& series() const { return series_; }
  const StepInputs& inputs() const { return inputs_; }
  int most_iterations() const { return iterations_; }

 private:
  /// Forces at the middle or the end, by the arguments that inputs_ lead to.
  struct Point {
    Eigen::VectorXd along_beam;
    Eigen::VectorXd force;
    AddedForces::HubTorque hub;
  };

  void form_inputs(const ArmState& now, HubMotion motion, const StepSpan& span, bool follows);
  void form_known(const StepTable& table, const Eigen::VectorXd& x);
  bool is_resolved(double begin_rad_per_s, double end_rad_per_s, HubMotion motion,
                   double largest_change) const;
  bool are_laws_resolved(const ArmState& now, std::span<const double> middle,
                         std::span<const double> end, HubMotion motion);
  bool try_turn(const ArmState& now, std::span<double> middle, std::span<double> end) const;
  bool are_states_resolved(const ArmState& now, std::span<const double> middle,
                           std::span<const double> end, bool is_turned) const;
  void take_mean_rates(const ArmState& now, std::span<const double> end);
  void evaluate(std::span<const double> arguments, double r, HubMotion motion, Point& point) const;
  double relative_change(bool is_turned) const;
  void improve();

  const ModalDynamics* arm_;
  const AddedForces* forces_;
  double force_tolerance_;
  int allowed_iterations_;
  bool turns_states_;
  int iterations_ = 0;
  StepInputs inputs_;
  std::array<double, 3> hub_torques_ = {};  // in inputs_: begin, middle, end
  HubMotion last_motion_ = HubMotion::frictionless;
  double last_rate_ = 0.0;            // of convergence, in the last step that was iterated
  double last_length_s_ = 0.0;        // 0: inputs_ are no guess for the next step
  Eigen::VectorXd known_;             // what StepTable::end maps
  Eigen::VectorXd arguments_;         // of forces: at the middle; at the end
  Eigen::VectorXd middle_arguments_;  // of a step by series
  Eigen::VectorXd law_arguments_;     // within a step
  Eigen::VectorXd law_rates_;
  double largest_torque_N_m_ = 0.0;  // on the hub, so far
  Eigen::VectorXd known_arguments_;  // the part of them that no iteration changes
  Point middle_point_;
  Point end_point_;
  Eigen::VectorXd middle_;
  Eigen::VectorXd end_;
  Expansion series_;
};

}  // namespace flexarm::response
