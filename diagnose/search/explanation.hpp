#pragma once

#include "diagnose/search/fit.hpp"
#include "diagnose/search/misfit.hpp"
#include "diagnose/search/residual_test.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::diagnose {

/// A fit with what it leaves of the runs that it was made of and of those it was not.
struct Explanation {
  Fit fit;
  Eigen::VectorXd held_out;  ///< residuals of the validation runs, 0 elsewhere
  Misfit estimation;         ///< nuisances included
  Misfit validation;         ///< count 0 without validation runs
  ResidualTest estimation_test;
  ResidualTest validation_test;  ///< passed without validation runs
  double score = 0.0;            ///< of the search (scored_fit.hpp)

  /// The residuals of both kinds of runs pass as noise (residual_test.hpp).
  bool leaves_noise() const { return estimation_test.is_noise() && validation_test.is_noise(); }
};

/// `problem` is the one that `fit` was made of.
Explanation explain(const Problem& problem, Fit fit);

/// The one of these effects, in whatever order; the end where there is none.
std::vector<Explanation>::iterator find_set(std::vector<Explanation>& among,
                                            const Candidate& effects);

/// The best fits first.
void sort_by_fit(std::vector<Explanation>& explanations);

/// The information (misfit.hpp) by which `fuller` leads `simpler` on the estimation runs.
double lead(const Explanation& fuller, const Explanation& simpler);

}  // namespace flexarm::diagnose
