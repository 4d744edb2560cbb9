#pragma once

#include <Eigen/Core>

#include <functional>

namespace flexarm::diagnose {

struct LeastSquaresOptions {
  int most_steps = 30;
  /// Converged where a step lowers the sum of squares by less than this part of it, or moves no
  /// place by more than this.
  double tolerance = 1e-7;
  /// The minimum and the Jacobian there are checked by difference quotients. Without, they are as
  /// the updates have them: a look.
  bool is_differenced_at_end = true;
};

struct LeastSquares {
  Eigen::VectorXd places = {};     ///< where the sum of squares is least
  Eigen::VectorXd residuals = {};  ///< there
  Eigen::MatrixXd jacobian = {};   ///< there, residuals by places
  int evaluations = 0;             ///< of the residuals
  bool converged = false;
};

/// As many residuals at each place; at one that is impossible all `kImpossibleResidual`.
using ResidualsAt = std::function<Eigen::VectorXd(const Eigen::VectorXd& places)>;
inline constexpr double kImpossibleResidual = 1e8;

/// From `start` to the nearest minimum of the sum of squares (Levenberg-Marquardt), with
/// derivatives by difference quotients over 1e-5 of a place: towards 0 above 0.5, away from it
/// below. Between them the Jacobian is updated by the residuals of each step [Broyden1965], as long
/// as it predicts these; the minimum is one by difference quotients, unless the options leave that
/// out. Without places the residuals are evaluated. `residuals` is called concurrently; its
/// exceptions pass through.
LeastSquares least_squares(const ResidualsAt& residuals, const Eigen::VectorXd& start,
                           const LeastSquaresOptions& options = {});

}  // namespace flexarm::diagnose
