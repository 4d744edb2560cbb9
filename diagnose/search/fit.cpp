#include "diagnose/search/fit.hpp"

#include "diagnose/search/least_squares.hpp"

#include <utility>

namespace flexarm::diagnose {

Eigen::VectorXd residuals_or_impossible(const Problem& problem, const Candidate& candidate) {
  if (auto residuals = problem.residuals(candidate, problem.estimation_runs())) {
    return *std::move(residuals);
  }
  return Eigen::VectorXd::Constant(problem.residual_count(), kImpossibleResidual);
}

Fit evaluated(const Problem& problem, const Candidate& candidate) {
  return {.candidate = candidate,
          .residuals = residuals_or_impossible(problem, candidate),
          .converged = true};
}

Fit fit(const Problem& problem, const Candidate& start, const FitOptions& options) {
  Fit made{.candidate = start};
  const auto residuals_at = [&](const Eigen::VectorXd& places) -> Eigen::VectorXd {
    if (options.work != nullptr) options.work->go_on();
    Candidate tried = start;
    tried.put(places);
    return residuals_or_impossible(problem, tried);
  };
  LeastSquares found = least_squares(residuals_at, start.coordinates(),
                                     {.most_steps = options.most_steps,
                                      .tolerance = options.tolerance,
                                      .is_differenced_at_end = options.is_differenced_at_end});
  made.candidate.put(found.places);
  made.sum_of_squares = found.residuals.squaredNorm();
  made.residuals = std::move(found.residuals);
  made.jacobian = std::move(found.jacobian);
  made.evaluations = found.evaluations;
  made.converged = found.converged;
  return made;
}

}  // namespace flexarm::diagnose
