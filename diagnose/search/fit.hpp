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
  /// Converged where a step lowers the sum of squares by less than this part of it, or moves no
  /// place by more than this.
  double tolerance = 1e-7;
  /// As in LeastSquaresOptions.
  bool is_differenced_at_end = true;
  const ReportedWork* work = nullptr;  ///< that the fit is part of; asked before each evaluation
};

/// Of the estimation runs; all kImpossibleResidual where the candidate's arm cannot be computed.
Eigen::VectorXd residuals_or_impossible(const Problem& problem, const Candidate& candidate);

/// Returns the candidate as it is, not fitted, without derivatives.
Fit evaluated(const Problem& problem, const Candidate& candidate);

/// From the candidate's own values to the nearest minimum (Levenberg-Marquardt). A candidate
/// without effects is evaluated. Throws Cancelled where the work is cancelled.
Fit fit(const Problem& problem, const Candidate& start, const FitOptions& options = {});

}  // namespace flexarm::diagnose
