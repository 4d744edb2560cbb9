#pragma once

#include <cstddef>
#include <span>

namespace flexarm::diagnose {

/// Sums over readings of squares of errors, each over the mean square of its channel's signal.
struct RelativeSquares {
  double readings = 0.0;
  double before = 0.0;
  double after = 0.0;
  double innovations = 0.0;  ///< of the residual after (RegimeError::innovation_ratio)
  double noise = 0.0;
  double noise_variance = 0.0;  ///< half of the variance of `noise` by chance

  RelativeSquares& operator+=(const RelativeSquares& other);
  /// Returns the p-value of the hypothesis that the residual after is noise.
  double noise_p_value() const;
};
using SquaresOf = double RelativeSquares::*;

/// Readings of consecutive samples of a run, those in a regime and the others.
struct RegimeBlock {
  std::size_t run = 0;
  RelativeSquares inside = {};
  RelativeSquares outside = {};
};

/// Readings that those in a regime are compared with: all others, or the others of their runs.
/// Runs with no others do not count then.
enum class Others { of_all_runs, of_the_run };

/// Returns the sum of the squares in a regime over that which is expected of the mean squares of
/// the others.
double squares_ratio(std::span<const RegimeBlock> blocks, SquaresOf squares, Others others);

/// Returns the p-value of the hypothesis that the squares in a regime are no larger than those of
/// the others (RegimeError::p_value). 1 where fewer than two blocks have readings in the regime, or
/// others.
double larger_inside_p_value(std::span<const RegimeBlock> blocks, SquaresOf squares, Others others);

}  // namespace flexarm::diagnose
