#include "diagnose/search/linear_refit.hpp"

#include "diagnose/search/fit.hpp"

#include <limits>

namespace flexarm::diagnose {

LinearRefit::LinearRefit(const Problem& problem, const Candidate& base, const ReportedWork& work)
    : problem_(problem) {
  const Fit as_it_is = fit(problem, base, {.most_steps = 0, .work = &work});
  parameters_ = as_it_is.jacobian.cols();
  if (parameters_ > 0) derivatives_.compute(as_it_is.jacobian);
}

std::optional<Eigen::VectorXd> LinearRefit::residuals(const Candidate& candidate) const {
  auto residuals = problem_.residuals(candidate, problem_.estimation_runs());
  if (!residuals || parameters_ == 0) return residuals;
  const Eigen::VectorXd turned = derivatives_.householderQ().adjoint() * *residuals;
  return turned.tail(turned.size() - derivatives_.rank());
}

double LinearRefit::sum_of_squares(const Candidate& candidate) const {
  const auto left = residuals(candidate);
  return left ? left->squaredNorm() : std::numeric_limits<double>::infinity();
}

Candidate LinearRefit::refitted(const Candidate& candidate) const {
  const auto before = problem_.residuals(candidate, problem_.estimation_runs());
  if (!before || parameters_ == 0) return candidate;
  Candidate made = candidate;
  Eigen::VectorXd places = candidate.coordinates();
  places.head(parameters_) -= derivatives_.solve(*before);
  made.put(places);
  const auto after = problem_.residuals(made, problem_.estimation_runs());
  return after && after->squaredNorm() < before->squaredNorm() ? made : candidate;
}

}  // namespace flexarm::diagnose
