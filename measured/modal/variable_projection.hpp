#pragma once

#include "measured/files/sensor_columns.hpp"
#include "measured/modal/block_signals.hpp"
#include "measured/modal/sensor_problem.hpp"

#include <Eigen/Core>

#include <functional>
#include <span>
#include <vector>

namespace flexarm::measured {

struct ProjectionOptions {
  /// Ends when the step still to go is below this many standard errors, in their metric.
  double step_in_standard_errors = 1e-4;
  int most_iterations = 60;
  /// Called before every evaluation, which passes over the data once; false ends the fit.
  std::function<bool()> go_on = {};
};

struct BlockFit {
  BlockSet blocks;
  std::vector<SensorModel> models;
  std::vector<SensorEstimate> sensors;
  Eigen::MatrixXd theta_covariance;  ///< for white noise
  double criterion = 0.0;            ///< sum over sensors of rows log(squares/rows)
  double parameter_count = 0.0;      ///< linear ones and theta
  int iterations = 0;
  bool converged = false;
  bool cancelled = false;

  /// criterion + parameters log(values): smaller is better [Schwarz1978].
  double bic() const;
  double values() const;
};

/// Poles by maximum likelihood for white normal noise of unknown size in each sensor: the minimum
/// over theta of
///
///     sum_j n_j log |(I - A_j A_j^+) y_j|^2,
///
/// rows times the weights of their stretches; variable projection [GolubPereyra1973] with
/// the Jacobian of [Kaufman1975], -(I - A A^+) dA beta, whose cross product is the Fisher
/// information of theta with beta eliminated, and Levenberg-Marquardt steps. All of a step is done
/// on the triangular factors of the stretches, so that its cost beyond one pass over the data does
/// not depend on their length.
BlockFit fit_blocks(std::span<const Stretch> stretches, std::span<const arm::Sensor> sensors,
                    const BlockSet& start, const ColumnChoices& choices,
                    const ProjectionOptions& options = {});

/// BIC of `fit` without each of its blocks from `first` on, the others as they are. `fit` is of
/// `stretches` and has no held blocks. One pass over the data for all.
std::vector<double> bic_without_each(std::span<const Stretch> stretches, const BlockFit& fit,
                                     std::size_t first);

}  // namespace flexarm::measured
