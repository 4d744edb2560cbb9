#pragma once

#include "response/driven_arm.hpp"

#include <Eigen/Core>

namespace flexarm::response {

struct SteadyStateOptions {
  /// Found when Newton's step is no longer than this times the state, or the sine's own scale.
  double tolerance = 1e-10;
  double linear_tolerance = 1e-16;  ///< the same without friction, drag and ripple; also found when
                                    ///< rounding no longer lets the steps shrink by half
  int most_steps = 20;              ///< of Newton
  int most_periods = 500;           ///< driven where Newton's steps do not find it
};

/// A state at the beginning of a period that comes again at its end.
struct SteadyState {
  Eigen::VectorXd state;
  bool is_held = false;
  bool found = false;  ///< false: what is there after `most_periods`
  long periods = 0;    ///< driven in all
};

/// The motion that is left when the transient has died out, by shooting (Aprille and Trick 1972):
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
