#pragma once

#include "diagnose/search/problem.hpp"

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
  int most_steps = 30;
  /// Converged where a step lowers the sum of squares by less than this part of it, or moves no
  /// place by more than this.
  double tolerance = 1e-7;
};

/// From the candidate's own values to the nearest minimum (Levenberg-Marquardt). A candidate
/// without effects is evaluated.
Fit fit(const Problem& problem, const Candidate& start, const FitOptions& options = {});

/// The best of `evaluations` places of the parameters of the last effect of `start`, the others as
/// they are: DIRECT-L (Gablonsky & Kelley 2001) over their whole range. Where runs are simulated
/// the sum of squares has many minima, each as wide as a few parts in a hundred of a frequency.
Candidate scan(const Problem& problem, const Candidate& start, int evaluations);
/// The same over some of its coordinates() alone.
Candidate scan(const Problem& problem, const Candidate& start,
               const std::vector<Eigen::Index>& coordinates, int evaluations);
/// ... and up to `most` places of it that are apart from each other, the best first.
std::vector<Candidate> scan_for_several(const Problem& problem, const Candidate& start,
                                        const std::vector<Eigen::Index>& coordinates,
                                        int evaluations, std::size_t most);

}  // namespace flexarm::diagnose
