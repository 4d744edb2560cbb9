#include "assumed_modes/legendre_series.hpp"

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>

namespace flexarm::assumed_modes {

Matrix integrated(const Matrix& series, Real length) {
  Matrix result = Matrix::Zero(series.rows(), series.cols());
  for (Eigen::Index k = 0; k + 1 < series.cols(); ++k) {
    const Vector term = series.col(k) * (length / static_cast<Real>(2 * (2 * k + 1)));
    result.col(k + 1) += term;
    if (k == 0) {
      result.col(0) += term;
    } else {
      result.col(k - 1) -= term;
    }
  }
  return result;
}

Matrix times_t(const Matrix& series) {
  // (2k + 1) t P_k = (k + 1) P_{k+1} + k P_{k-1}
  Matrix result = Matrix::Zero(series.rows(), series.cols() + 1);
  for (Eigen::Index k = 0; k < series.cols(); ++k) {
    const Vector term = series.col(k) / static_cast<Real>(2 * k + 1);
    result.col(k + 1) += static_cast<Real>(k + 1) * term;
    if (k > 0) result.col(k - 1) += static_cast<Real>(k) * term;
  }
  return result;
}

Vector evaluated(const Matrix& series, Real t) {
  Vector polynomials = Vector::Ones(series.cols());
  if (series.cols() > 1) polynomials(1) = t;
  for (Eigen::Index k = 1; k + 1 < series.cols(); ++k) {
    polynomials(k + 1) =
        boost::math::legendre_next(static_cast<unsigned>(k), t, polynomials(k), polynomials(k - 1));
  }
  return series * polynomials;
}

Vector at_end(const Matrix& series) {
  return series.rowwise().sum();
}

Matrix products(const Matrix& f, const Matrix& g, Real length) {
  const Eigen::Index common = std::min(f.cols(), g.cols());
  const Vector square_norm = Vector::NullaryExpr(
      common, [length](Eigen::Index k) { return length / static_cast<Real>(2 * k + 1); });
  return f.leftCols(common) * square_norm.asDiagonal() * g.leftCols(common).transpose();
}

}  // namespace flexarm::assumed_modes
