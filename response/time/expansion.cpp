#include "response/time/expansion.hpp"

#include <algorithm>

namespace flexarm::response {

namespace {

/// Terms below this times the largest do not count, even summed.
constexpr double kNegligible = 1e-18;

}  // namespace

void Expansion::compute(const Eigen::MatrixXd& a, double step_s, const Eigen::VectorXd& x0,
                        const std::array<Eigen::VectorXd, 3>& inputs) {
  step_s_ = step_s;
  terms_by_column_.resize(x0.size(), kMostTerms);
  terms_by_column_.col(0) = x0;
  double largest = x0.cwiseAbs().maxCoeff();
  terms_ = 1;
  int negligible = 0;
  while (terms_ < kMostTerms && negligible < 2) {
    const Eigen::Index k = terms_ - 1;
    auto next = terms_by_column_.col(terms_);
    next.noalias() = a * terms_by_column_.col(k);
    if (k < 3) next += inputs[static_cast<std::size_t>(k)];
    next *= step_s / static_cast<double>(terms_);
    const double size = next.cwiseAbs().maxCoeff();
    largest = std::max(largest, size);
    negligible = k >= 3 && size <= kNegligible * largest ? negligible + 1 : 0;
    ++terms_;
  }
}

Eigen::VectorXd Expansion::at(double r) const {
  Eigen::VectorXd x = terms_by_column_.col(terms_ - 1);
  for (Eigen::Index k = terms_ - 1; k-- > 0;) x = terms_by_column_.col(k) + r * x;
  return x;
}

}  // namespace flexarm::response
