#pragma once

#include "response/time/driven_arm.hpp"

#include <Eigen/Core>

namespace flexarm::response {

struct SteadyStateOptions {
  /// Newton goes on until rounding no longer lets its steps shrink by half. With friction, drag or
  /// ripple the step must then be no longer than this times the state, or the sine's own scale.
  double tolerance = 1e-9;
  int most_steps = 20;        ///< of Newton
  int most_attempts = 5;      ///< of Newton, from where the arm then is
  int periods_between = 100;  ///< driven behind an attempt that failed
};

/// A state at the beginning of a period that comes again at its end.
struct SteadyState {
  Eigen::VectorXd state;
  bool is_held = false;
  bool found = false;  ///< false: what is there after the attempts
  long periods = 0;    ///< driven in all
};

/// The motion that is left when the transient has died out, by shooting [AprilleTrick1972]:
/// Newton's method on F(X) - X = 0, F the state after one period, its derivative by differences.
/// For a linear arm that is one step, and exact. A lightly damped transient, which takes thousands
/// of periods to die out, thus costs some tens.
///
/// A free arm's angle may stand anywhere and, under a torque with a mean, drift: where F' - 1 has
/// singular values below 1e-9 of the largest (linear) or 1e-6, X comes again but for multiples of
/// their directions. Without viscous friction a mean accelerates the arm, and only the rest comes
/// again.
///
/// `guess` is where to begin, as long as the arm's states. Leaves the arm at the state found.
SteadyState find_steady_state(DrivenArm& arm, const Eigen::VectorXd& guess, bool is_held,
                              const SteadyStateOptions& options = {});

}  // namespace flexarm::response
