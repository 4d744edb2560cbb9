#pragma once

#include "response/time/modal_dynamics.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace flexarm::response {

/// The solution of X' = A X + c0 + c1 r + c2 r^2 over a step, r = t/dt from 0 to 1, as its power
/// series in r:
///
///     X_(k+1) = dt/(k+1) (A X_k + c_k).
///
/// Exact to rounding for |A| dt of a few units at most: terms fall as (|A| dt)^k/k! and are taken
/// until they no longer count. The series gives any reading at any instant for a few
/// multiplications, which is what locating events needs, and does not mind defective A.
///
/// A lagged reading W' = g(r) - rho W, rho = dt/time constant, may be as fast as it likes. Where
/// rho > 1 it is its particular solution, the polynomial
///
///     q_k = (g_k - (k+1) q_(k+1))/rho,
///
/// and (W(0) - q(0)) e^(-rho r).
class Expansion {
 public:
  void compute(const LinearSystem& system, double step_s, const Eigen::VectorXd& x0,
               const std::array<Eigen::VectorXd, 3>& inputs);

  double step_s() const { return step_s_; }
  Eigen::Index terms() const { return terms_; }
  /// X(r), N.
  Eigen::VectorXd at(double r) const;
  /// The series of `row` X; `row` may not contain W.
  Eigen::RowVectorXd of(const Eigen::RowVectorXd& row) const {
    return row * terms_by_column_.leftCols(terms_);
  }

 private:
  struct FastLag {
    Eigen::Index row;
    double rate;   ///< rho
    double decay;  ///< W(0) - q(0)
  };

  static constexpr Eigen::Index kMostTerms = 80;
  Eigen::MatrixXd terms_by_column_;  // N x kMostTerms
  Eigen::Index terms_ = 0;
  double step_s_ = 0.0;
  std::vector<FastLag> fast_lags_;
};

}  // namespace flexarm::response
