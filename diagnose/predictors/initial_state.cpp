#include "diagnose/predictors/initial_state.hpp"

#include <limits>

namespace flexarm::diagnose {

using Eigen::Index;

InitialStateEstimator::InitialStateEstimator(const Eigen::MatrixXd& per_state,
                                             const Eigen::VectorXd& deviations,
                                             const Eigen::VectorXd& measured)
    : deviations_(deviations) {
  const Index states = per_state.cols();
  Eigen::MatrixXd weighted = deviations.cwiseInverse().asDiagonal() * per_state;
  scale_ = weighted.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min());
  weighted *= scale_.cwiseInverse().asDiagonal();
  const double size = measured.cwiseQuotient(deviations).norm();
  prior_ = size > 0.0 ? 1.0 / size : 1.0;
  weighted.conservativeResize(weighted.rows() + states, Eigen::NoChange);
  weighted.bottomRows(states) = prior_ * Eigen::MatrixXd::Identity(states, states);
  solver_.compute(weighted);
}

Eigen::VectorXd InitialStateEstimator::step(const Eigen::VectorXd& left,
                                            const Eigen::VectorXd& state) const {
  Eigen::VectorXd wanted(left.size() + state.size());
  wanted << left.cwiseQuotient(deviations_), -prior_ * scale_.cwiseProduct(state);
  return solver_.solve(wanted).cwiseQuotient(scale_);
}

double InitialStateEstimator::cost(const Eigen::VectorXd& left,
                                   const Eigen::VectorXd& state) const {
  return left.cwiseQuotient(deviations_).squaredNorm() +
         prior_ * prior_ * scale_.cwiseProduct(state).squaredNorm();
}

}  // namespace flexarm::diagnose
