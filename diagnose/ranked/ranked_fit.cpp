#include "diagnose/ranked/ranked_fit.hpp"

#include "diagnose/parallel.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The difference quotient of a place.
constexpr double kPlaceStep = 1e-4;
/// The longest step of a place.
constexpr double kLongestStep = 0.35;
constexpr double kFirstDamping = 1e-3;
constexpr double kMostDamping = 1e6;

/// The places of a candidate, and which of them end at 0 and 1.
class Places {
 public:
  explicit Places(const Candidate& start) : start_(start), unbounded_(std::ssize(start.nuisances)) {
    for (const SearchedParameter& one : start.parameters()) is_periodic_.push_back(one.periodic);
  }

  Candidate at(const VectorXd& places) const {
    Candidate made = start_;
    made.put(places);
    return made;
  }
  bool is_bounded(Index i) const {
    return i >= unbounded_ && !is_periodic_[static_cast<std::size_t>(i - unbounded_)];
  }
  VectorXd bounded(VectorXd places) const {
    for (Index i = 0; i < places.size(); ++i) {
      if (is_bounded(i)) places(i) = std::clamp(places(i), 0.0, 1.0);
    }
    return places;
  }

 private:
  const Candidate& start_;
  Index unbounded_;
  std::vector<bool> is_periodic_;
};

/// The lines by the places, by difference quotients inwards; a column that cannot be computed is 0.
MatrixXd jacobian_at(const Likelihood& likelihood, const Places& places, const VectorXd& here,
                     const VectorXd& residuals, const ReportedWork& work) {
  MatrixXd jacobian = MatrixXd::Zero(residuals.size(), here.size());
  in_parallel(static_cast<std::size_t>(here.size()), [&](std::size_t k) {
    work.go_on();
    const auto i = static_cast<Index>(k);
    VectorXd beside = here;
    const double step = here(i) < 0.5 ? kPlaceStep : -kPlaceStep;
    beside(i) += step;
    const auto moved = likelihood.problem().residuals(places.at(beside), likelihood.runs());
    if (moved) jacobian.col(i) = likelihood.lines((*moved - residuals) / step);
  });
  return jacobian;
}

/// The damped Gauss-Newton step of -2 ln L, places at a bound that it would leave held there.
VectorXd damped_step(const MatrixXd& normal, const VectorXd& gradient, const VectorXd& here,
                     const Places& places, double damping) {
  std::vector<bool> is_held(static_cast<std::size_t>(here.size()), false);
  VectorXd step = VectorXd::Zero(here.size());
  for (Index pass = 0; pass <= here.size(); ++pass) {
    MatrixXd damped = normal;
    VectorXd downhill = -gradient;
    for (Index i = 0; i < here.size(); ++i) {
      damped(i, i) += damping * normal(i, i) + 1e-12 * (1.0 + normal.trace());
      if (!is_held[static_cast<std::size_t>(i)]) continue;
      damped.row(i).setZero();
      damped.col(i).setZero();
      damped(i, i) = 1.0;
      downhill(i) = 0.0;
    }
    step = damped.ldlt().solve(downhill);
    bool is_inside = true;
    for (Index i = 0; i < here.size(); ++i) {
      const bool at_bound = places.is_bounded(i) && ((here(i) <= 0.0 && step(i) < 0.0) ||
                                                     (here(i) >= 1.0 && step(i) > 0.0));
      if (!at_bound) continue;
      is_held[static_cast<std::size_t>(i)] = true;
      is_inside = false;
    }
    if (is_inside) break;
  }
  const double longest = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0.0;
  if (longest > kLongestStep) step *= kLongestStep / longest;
  return step;
}

}  // namespace

double price(const Candidate& candidate, const MatrixXd& jacobian, const VectorXd& weights) {
  double sum = 0.0;
  for (const Hypothesis& effect : candidate.effects) {
    sum -= 2.0 * std::log(effects::probability_of(effect.entry->prior));
  }
  if (jacobian.cols() == 0) return sum;
  MatrixXd weighted = weights.cwiseSqrt().asDiagonal() * jacobian;
  weighted.rightCols(std::ssize(candidate.values)) *= kPlaceDeviation;
  MatrixXd information = weighted.transpose() * weighted;
  information.diagonal().array() += 1.0;
  const VectorXd pivots = information.ldlt().vectorD();
  return sum + pivots.array().max(1.0).log().sum();
}

RankedFit ranked_fit(const Likelihood& likelihood, const Candidate& start, const ReportedWork& work,
                     const RankedFitOptions& options) {
  const Places places(start);
  RankedFit made{.candidate = start};
  VectorXd here = places.bounded(start.coordinates());
  made.candidate.put(here);
  work.go_on();
  auto residuals = likelihood.problem().residuals(made.candidate, likelihood.runs());
  if (!residuals) return made;
  made.residuals = *std::move(residuals);
  made.lines = likelihood.lines(made.residuals);
  made.cost = likelihood.cost(made.lines);
  double damping = kFirstDamping;
  for (int steps = 0;; ++steps) {
    made.jacobian = jacobian_at(likelihood, places, here, made.residuals, work);
    const VectorXd weights = likelihood.weights(made.lines);
    made.score = made.cost + price(made.candidate, made.jacobian, weights);
    if (here.size() == 0 || made.converged || steps == options.most_steps) break;
    const MatrixXd weighted = weights.asDiagonal() * made.jacobian;
    const MatrixXd normal = made.jacobian.transpose() * weighted;
    const VectorXd gradient = weighted.transpose() * made.lines;
    bool has_moved = false;
    while (!has_moved && damping < kMostDamping) {
      const VectorXd step = damped_step(normal, gradient, here, places, damping);
      const double expected = -(2.0 * gradient + normal * step).dot(step);
      if (expected < options.tolerance) break;
      const VectorXd there = places.bounded(here + step);
      work.go_on();
      const Candidate tried = places.at(there);
      auto left = likelihood.problem().residuals(tried, likelihood.runs());
      const VectorXd lines = left ? likelihood.lines(*left) : VectorXd();
      const double cost = left ? likelihood.cost(lines) : made.cost;
      if (!(cost < made.cost)) {
        damping *= 8.0;
        continue;
      }
      made.converged = made.cost - cost < options.tolerance;
      has_moved = true;
      damping /= 5.0;
      here = there;
      made.candidate = tried;
      made.residuals = *std::move(left);
      made.lines = lines;
      made.cost = cost;
    }
    if (!has_moved) {
      made.converged = true;
      break;
    }
  }
  return made;
}

}  // namespace flexarm::diagnose
