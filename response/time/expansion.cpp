#include "response/time/expansion.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::response {

namespace {

/// Terms below this times the largest do not count, even summed.
constexpr double kNegligible = 1e-18;

}  // namespace

void Expansion::compute(const LinearSystem& system, double step_s, const Eigen::VectorXd& x0,
                        const std::array<Eigen::VectorXd, 3>& inputs) {
  step_s_ = step_s;
  terms_by_column_.resize(x0.size(), kMostTerms);
  terms_by_column_.col(0) = x0;
  fast_lags_.clear();
  for (const Eigen::Index w : system.lagged_readings) {
    const double rate = -system.a(w, w) * step_s;
    if (rate > 1.0) fast_lags_.push_back({w, rate, x0(w)});
  }
  // Zero until the series that drives it is known.
  for (const FastLag& lag : fast_lags_) terms_by_column_(lag.row, 0) = 0.0;
  double largest = terms_by_column_.col(0).cwiseAbs().maxCoeff();
  terms_ = 1;
  int negligible = 0;
  while (terms_ < kMostTerms && negligible < 2) {
    const Eigen::Index k = terms_ - 1;
    auto next = terms_by_column_.col(terms_);
    next.noalias() = system.a * terms_by_column_.col(k);
    if (k < 3) next += inputs[static_cast<std::size_t>(k)];
    next *= step_s / static_cast<double>(terms_);
    for (const FastLag& lag : fast_lags_) next(lag.row) = 0.0;
    const double size = next.cwiseAbs().maxCoeff();
    largest = std::max(largest, size);
    negligible = k >= 3 && size <= kNegligible * largest ? negligible + 1 : 0;
    ++terms_;
  }
  for (FastLag& lag : fast_lags_) {
    Eigen::RowVectorXd q = of(system.a.row(lag.row) * step_s);
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      q(static_cast<Eigen::Index>(k)) += inputs[k](lag.row) * step_s;
    }
    q(terms_ - 1) /= lag.rate;
    for (Eigen::Index k = terms_ - 1; k-- > 0;) {
      q(k) = (q(k) - static_cast<double>(k + 1) * q(k + 1)) / lag.rate;
    }
    terms_by_column_.row(lag.row).head(terms_) = q;
    lag.decay -= q(0);
  }
}

Eigen::VectorXd Expansion::at(double r) const {
  Eigen::VectorXd x = terms_by_column_.col(terms_ - 1);
  for (Eigen::Index k = terms_ - 1; k-- > 0;) x = terms_by_column_.col(k) + r * x;
  for (const FastLag& lag : fast_lags_) x(lag.row) += lag.decay * std::exp(-lag.rate * r);
  return x;
}

}  // namespace flexarm::response
