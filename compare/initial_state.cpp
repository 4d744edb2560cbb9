#include "compare/initial_state.hpp"

#include <algorithm>
#include <limits>

namespace flexarm::compare {

using Eigen::Index;

Eigen::VectorXd prior_of_state(const Eigen::MatrixXd& per_state, const Eigen::VectorXd& deviations,
                               const Eigen::VectorXd& measured) {
  const Eigen::VectorXd weights = deviations.cwiseInverse();
  const Eigen::VectorXd own = (weights.asDiagonal() * per_state).colwise().norm();
  const double size = weights.cwiseProduct(measured).norm();
  const double least = std::max(kLeastShown * own.maxCoeff(), std::numeric_limits<double>::min());
  return (size > 0.0 ? size : 1.0) * own.cwiseMax(least).cwiseInverse();
}

InitialStateEstimator::InitialStateEstimator(const Eigen::MatrixXd& per_state,
                                             const Eigen::VectorXd& deviations,
                                             const Eigen::VectorXd& measured)
    : prior_(prior_of_state(per_state, deviations, measured)), deviations_(deviations) {
  const Index states = per_state.cols();
  Eigen::MatrixXd weighted(per_state.rows() + states, states);
  weighted << deviations.cwiseInverse().asDiagonal() * per_state * prior_.asDiagonal(),
      Eigen::MatrixXd::Identity(states, states);
  solver_.compute(weighted);
}

Eigen::VectorXd InitialStateEstimator::step(const Eigen::VectorXd& left,
                                            const Eigen::VectorXd& state) const {
  Eigen::VectorXd wanted(left.size() + state.size());
  wanted << left.cwiseQuotient(deviations_), -state.cwiseQuotient(prior_);
  return solver_.solve(wanted).cwiseProduct(prior_);
}

double InitialStateEstimator::cost(const Eigen::VectorXd& left,
                                   const Eigen::VectorXd& state) const {
  return left.cwiseQuotient(deviations_).squaredNorm() + state.cwiseQuotient(prior_).squaredNorm();
}

}  // namespace flexarm::compare
