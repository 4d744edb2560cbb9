#include "diagnose/autoregression.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::diagnose {

using Eigen::Index;

Autoregression::Autoregression(const Eigen::Ref<const Eigen::VectorXd>& values, int most_order) {
  const auto n = static_cast<double>(values.size());
  const int orders = std::min(most_order, static_cast<int>(values.size()) / 4);
  Eigen::VectorXd forward = values;
  Eigen::VectorXd backward = values;
  Eigen::VectorXd predictor(0);
  double variance = 1.0;
  double least = 0.0;
  std::size_t best = 0;
  for (int m = 1; m <= orders; ++m) {
    // Errors of prediction from the m - 1 numbers before, and from those after, side by side.
    const Index rest = values.size() - m;
    const Eigen::VectorXd ahead = forward.tail(rest);
    const Eigen::VectorXd behind = backward.head(rest);
    const double squares = ahead.squaredNorm() + behind.squaredNorm();
    if (!(squares > 0.0)) break;
    const double reflection = -2.0 * ahead.dot(behind) / squares;
    variance *= 1.0 - reflection * reflection;
    if (!(variance > 0.0)) break;
    forward = ahead + reflection * behind;
    backward = behind + reflection * ahead;
    Eigen::VectorXd longer(m);
    longer.head(m - 1) = predictor + reflection * predictor.reverse();
    longer(m - 1) = reflection;
    predictor = longer;
    predictors_.push_back(predictor);
    deviations_.push_back(std::sqrt(variance));
    const double criterion = n * std::log(variance) + 2.0 * m;
    if (criterion < least) {
      least = criterion;
      best = predictors_.size();
    }
  }
  predictors_.resize(best);
  deviations_.resize(best);
}

double Autoregression::power(double frequency) const {
  if (order() == 0) return 1.0;
  const Eigen::VectorXd& a = predictors_.back();
  std::complex<double> sum = 1.0;
  for (Index m = 0; m < a.size(); ++m) {
    const double angle = -2.0 * std::numbers::pi * frequency * static_cast<double>(m + 1);
    sum += a(m) * std::polar(1.0, angle);
  }
  return innovation() * innovation() / std::norm(sum);
}

double Autoregression::predicted(const Eigen::Ref<const Eigen::VectorXd>& values, Index k) const {
  const Index m = std::min<Index>(k, order());
  if (m == 0) return 0.0;
  const auto& predictor = predictors_[static_cast<std::size_t>(m - 1)];
  return -predictor.dot(values.segment(k - m, m).reverse());
}

double Autoregression::deviation(Index k) const {
  const Index m = std::min<Index>(k, order());
  return m == 0 ? 1.0 : deviations_[static_cast<std::size_t>(m - 1)];
}

void Autoregression::whiten(Eigen::Ref<Eigen::VectorXd> values) const {
  if (order() == 0) return;
  for (Index k = values.size() - 1; k >= 0; --k) {
    values(k) = (values(k) - predicted(values, k)) / deviation(k);
  }
}

void Autoregression::colour(Eigen::Ref<Eigen::VectorXd> values) const {
  if (order() == 0) return;
  for (Index k = 0; k < values.size(); ++k) {
    values(k) = values(k) * deviation(k) + predicted(values, k);
  }
}

}  // namespace flexarm::diagnose
