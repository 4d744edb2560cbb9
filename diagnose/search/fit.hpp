#pragma once

#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"

#include <Eigen/Core>

namespace flexarm::diagnose {

/// A candidate refitted to the estimation runs by least squares of its simulation (output) error.
struct Fit {
  Candidate candidate = {};
  Eigen::VectorXd residuals = {};  ///< of the estimation runs: Problem::residuals
  double sum_of_squares = 0.0;     ///< of these; infinite where nothing could be computed
  /// Residuals by places of the parameters, where the fit ended.
  Eigen::MatrixXd jacobian = {};
  int evaluations = 0;  ///< of the model
  bool converged = false;
};

struct FitOptions {
  int most_steps = 60;
  /// Converged where a step is expected to lower the sum of squares by less than this part of it.
  double tolerance = 1e-7;
  const ReportedWork* work = nullptr;  ///< that the fit is part of; asked before each evaluation
};

/// Returns the candidate as it is, not fitted, without derivatives; the residuals are all
/// kImpossibleResidual where its arm cannot be computed.
Fit evaluated(const Problem& problem, const Candidate& candidate);
inline constexpr double kImpossibleResidual = 1e8;

/// Returns the minimum of the sum of squares that is nearest to `start` (minimise.hpp); where that
/// cannot be computed, `evaluated`. Throws Cancelled where the work is cancelled.
Fit fit(const Problem& problem, const Candidate& start, const FitOptions& options = {});

}  // namespace flexarm::diagnose
