#include "diagnose/autoregression.hpp"

#include <Eigen/Cholesky>

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

Eigen::VectorXd Autoregression::whitened_impulse(Index k, Index n) const {
  Eigen::VectorXd made(std::min<Index>(order() + 1, n - k));
  made(0) = 1.0 / deviation(k);
  for (Index i = 1; i < made.size(); ++i) {
    const Index m = std::min<Index>(k + i, order());
    made(i) = predictors_[static_cast<std::size_t>(m - 1)](i - 1) / deviation(k + i);
  }
  return made;
}

void Autoregression::whiten(Eigen::Ref<Eigen::VectorXd> values,
                            const std::vector<std::size_t>& left_out) const {
  for (const std::size_t k : left_out) values(static_cast<Index>(k)) = 0.0;
  whiten(values);
  // Impulses further apart than the order do not overlap: each group by itself.
  for (auto first = left_out.begin(); first != left_out.end() && order() > 0;) {
    auto last = first + 1;
    while (last != left_out.end() && *last <= *(last - 1) + static_cast<std::size_t>(order())) {
      ++last;
    }
    const auto begin = static_cast<Index>(*first);
    const auto end = std::min<Index>(values.size(), static_cast<Index>(*(last - 1)) + order() + 1);
    Eigen::MatrixXd impulses = Eigen::MatrixXd::Zero(end - begin, last - first);
    for (auto k = first; k != last; ++k) {
      const Eigen::VectorXd own = whitened_impulse(static_cast<Index>(*k), values.size());
      impulses.col(k - first).segment(static_cast<Index>(*k) - begin, own.size()) = own;
    }
    auto reached = values.segment(begin, end - begin);
    const Eigen::MatrixXd products = impulses.transpose() * impulses;
    const Eigen::VectorXd along = impulses.transpose() * reached;
    reached -= impulses * Eigen::LDLT<Eigen::MatrixXd>(products).solve(along);
    first = last;
  }
}

void Autoregression::fill(Eigen::Ref<Eigen::VectorXd> values,
                          const std::vector<std::size_t>& left_out) const {
  if (left_out.empty()) return;
  Eigen::VectorXd filled = values;
  whiten(filled, left_out);
  colour(filled);
  for (const std::size_t k : left_out) {
    values(static_cast<Index>(k)) = filled(static_cast<Index>(k));
  }
}

void fill_by_autoregression(Eigen::Ref<Eigen::VectorXd> values,
                            const std::vector<std::size_t>& left_out, int most_order) {
  constexpr int kRounds = 3;
  for (const std::size_t k : left_out) values(static_cast<Index>(k)) = 0.0;
  for (int round = 0; round < kRounds && !left_out.empty(); ++round) {
    const double size = values.norm() / std::sqrt(static_cast<double>(values.size()));
    if (!(size > 0.0)) return;
    Autoregression(values / size, most_order).fill(values, left_out);
  }
}

}  // namespace flexarm::diagnose
