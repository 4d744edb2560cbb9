#include "diagnose/search/fit.hpp"

#include "diagnose/search/minimise.hpp"

#include <utility>

namespace flexarm::diagnose {

namespace {

/// The sum of squares of the residuals of the estimation runs.
class SumOfSquares final : public Objective {
 public:
  explicit SumOfSquares(const Problem& problem) : problem_(problem) {}

  std::optional<Eigen::VectorXd> lines_of(const Candidate& candidate) const override {
    return problem_.residuals(candidate, problem_.estimation_runs());
  }
  double cost(const Eigen::VectorXd& residuals) const override { return residuals.squaredNorm(); }
  Eigen::VectorXd weights(const Eigen::VectorXd& residuals) const override {
    return Eigen::VectorXd::Ones(residuals.size());
  }

 private:
  const Problem& problem_;
};

}  // namespace

Fit evaluated(const Problem& problem, const Candidate& candidate) {
  Fit made{.candidate = candidate, .converged = true};
  auto residuals = problem.residuals(candidate, problem.estimation_runs());
  made.residuals = residuals
                       ? *std::move(residuals)
                       : Eigen::VectorXd::Constant(problem.residual_count(), kImpossibleResidual);
  made.sum_of_squares = made.residuals.squaredNorm();
  return made;
}

Fit fit(const Problem& problem, const Candidate& start, const FitOptions& options) {
  const ReportedWork unreported({});
  Minimum found =
      minimise(SumOfSquares(problem), start, options.work != nullptr ? *options.work : unreported,
               {.most_steps = options.most_steps,
                .tolerance = 0.0,
                .relative_tolerance = options.tolerance});
  if (!found.is_possible()) return evaluated(problem, start);
  return {.candidate = std::move(found.candidate),
          .residuals = std::move(found.lines),
          .sum_of_squares = found.cost,
          .jacobian = std::move(found.jacobian),
          .evaluations = found.evaluations,
          .converged = found.converged};
}

}  // namespace flexarm::diagnose
