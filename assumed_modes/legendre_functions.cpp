#include "assumed_modes/legendre_functions.hpp"

#include <boost/math/special_functions/legendre.hpp>

#include <cmath>

namespace flexarm::assumed_modes {

namespace {

/// Coefficients of the integral from 0 to xi of each row's Legendre series in 2 xi - 1:
/// int_{-1}^{t} P_k = (P_{k+1} - P_{k-1})/(2k + 1), and P_1 + P_0 for k = 0. The last column of
/// `series` must be zero.
Matrix integrated_from_root(const Matrix& series) {
  Matrix result = Matrix::Zero(series.rows(), series.cols());
  for (Eigen::Index k = 0; k + 1 < series.cols(); ++k) {
    const Vector term = series.col(k) / static_cast<Real>(2 * (2 * k + 1));
    result.col(k + 1) += term;
    if (k == 0) {
      result.col(0) += term;
    } else {
      result.col(k - 1) -= term;
    }
  }
  return result;
}

}  // namespace

LegendreFunctions::LegendreFunctions(int count) {
  Matrix& second = coefficients_[2];
  second = Matrix::Zero(count, count + 2);
  for (Eigen::Index k = 0; k < count; ++k) second(k, k) = std::sqrt(static_cast<Real>(2 * k + 1));
  coefficients_[1] = integrated_from_root(second);
  coefficients_[0] = integrated_from_root(coefficients_[1]);
}

Integrals LegendreFunctions::integrals() const {
  const Matrix& psi = coefficients_[0];
  // int_0^1 P_k(2 xi - 1)^2 = 1/(2k + 1), and xi = (P_0 + P_1)/2.
  const Vector square_norm = Vector::NullaryExpr(
      psi.cols(), [](Eigen::Index k) { return 1 / static_cast<Real>(2 * k + 1); });
  Integrals result;
  result.mass = psi * square_norm.asDiagonal() * psi.transpose();
  result.moment = psi.col(0) / 2 + psi.col(1) / 6;
  result.root_slope = Vector::Zero(psi.rows());
  result.tip = values(1, 0);
  result.tip_slope = values(1, 1);
  return result;
}

Vector LegendreFunctions::values(Real xi, int derivative) const {
  const Matrix& series = coefficients_.at(static_cast<std::size_t>(derivative));
  Vector polynomials(series.cols());
  const Real t = 2 * xi - 1;
  polynomials(0) = 1;
  polynomials(1) = t;
  for (Eigen::Index k = 1; k + 1 < series.cols(); ++k) {
    polynomials(k + 1) =
        boost::math::legendre_next(static_cast<unsigned>(k), t, polynomials(k), polynomials(k - 1));
  }
  return series * polynomials;
}

}  // namespace flexarm::assumed_modes
