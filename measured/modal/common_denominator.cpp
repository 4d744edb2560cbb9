#include "measured/modal/common_denominator.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <cmath>
#include <utility>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kReweightings = 2;
constexpr double kRankTolerance = 1e-13;

/// A signal of an equation: y, then its inputs.
const ArrayXcd& signal(const DenominatorEquation& equation, std::size_t i) {
  return i == 0 ? equation.y : equation.inputs[i - 1];
}

ArrayXcd circle(const ArrayXd& angle) {
  ArrayXcd z(angle.size());
  for (Index k = 0; k < angle.size(); ++k) z(k) = std::polar(1.0, angle(k));
  return z;
}

ArrayXcd polynomial(const VectorXd& coefficients, const ArrayXcd& z) {
  ArrayXcd value = ArrayXcd::Constant(z.size(), coefficients(coefficients.size() - 1));
  for (Index i = coefficients.size() - 2; i >= 0; --i) value = value * z + coefficients(i);
  return value;
}

/// Re sum product z^lag for lags 0 to order.
VectorXd moments(ArrayXcd product, const ArrayXcd& z, int order) {
  VectorXd m(order + 1);
  for (int lag = 0; lag <= order; ++lag) {
    m(lag) = product.real().sum();
    product *= z;
  }
  return m;
}

VectorXd solve(const MatrixXd& matrix, const VectorXd& right) {
  const VectorXd scale = matrix.diagonal().cwiseAbs().cwiseSqrt().unaryExpr(
      [](double d) { return d > 0.0 ? d : 1.0; });
  const VectorXd unit = scale.cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
  decomposition.setThreshold(kRankTolerance);
  const MatrixXd scaled = unit.asDiagonal() * matrix * unit.asDiagonal();
  decomposition.compute(scaled);
  // A matrix, for the compiler takes seconds for each type of the right side.
  const MatrixXd scaled_right = unit.asDiagonal() * right;
  return unit.asDiagonal() * decomposition.solve(scaled_right);
}

}  // namespace

CommonDenominator::CommonDenominator(std::vector<DenominatorEquation> equations, int highest_order)
    : equations_(std::move(equations)), order_(highest_order) {
  std::vector<ArrayXd> weights;
  for (const auto& equation : equations_) weights.push_back(ArrayXd::Ones(equation.angle.size()));
  form_sums(weights);
  for (int i = 0; i < kReweightings; ++i) {
    const VectorXd a = denominator(order_);
    for (std::size_t e = 0; e < equations_.size(); ++e) {
      weights[e] = polynomial(a, circle(equations_[e].angle)).abs2().inverse();
    }
    form_sums(weights);
  }
}

void CommonDenominator::form_sums(const std::vector<ArrayXd>& weights) {
  sums_.assign(equations_.size(), {});
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    const auto& equation = equations_[e];
    const std::size_t signals = equation.inputs.size() + 1;
    const ArrayXcd z = circle(equation.angle);
    sums_[e].signals = signals;
    sums_[e].moments.resize(signals * signals);
    for (std::size_t a = 0; a < signals; ++a) {
      for (std::size_t b = a; b < signals; ++b) {
        const ArrayXcd product = signal(equation, a).conjugate() * signal(equation, b) * weights[e];
        sums_[e].moments[a * signals + b] = moments(product, z, order_);
        if (b > a) sums_[e].moments[b * signals + a] = moments(product.conjugate(), z, order_);
      }
    }
  }
}

MatrixXd CommonDenominator::block(const Sums& sums, std::size_t a, std::size_t b, int order) const {
  const VectorXd& ahead = sums.moments[a * sums.signals + b];
  const VectorXd& behind = sums.moments[b * sums.signals + a];
  MatrixXd toeplitz(order + 1, order + 1);
  for (Index i = 0; i <= order; ++i) {
    for (Index k = 0; k <= order; ++k) toeplitz(i, k) = k >= i ? ahead(k - i) : behind(i - k);
  }
  return toeplitz;
}

MatrixXd CommonDenominator::inputs_matrix(const Sums& sums, int order) const {
  const auto inputs = static_cast<Index>(equations_.front().inputs.size());
  MatrixXd matrix(inputs * (order + 1), inputs * (order + 1));
  for (Index a = 0; a < inputs; ++a) {
    for (Index b = 0; b < inputs; ++b) {
      matrix.block(a * (order + 1), b * (order + 1), order + 1, order + 1) =
          block(sums, static_cast<std::size_t>(a) + 1, static_cast<std::size_t>(b) + 1, order);
    }
  }
  return matrix;
}

MatrixXd CommonDenominator::mixed_matrix(const Sums& sums, int order) const {
  const auto inputs = static_cast<Index>(equations_.front().inputs.size());
  MatrixXd matrix(inputs * (order + 1), order + 1);
  for (Index a = 0; a < inputs; ++a) {
    matrix.middleRows(a * (order + 1), order + 1) =
        block(sums, static_cast<std::size_t>(a) + 1, 0, order);
  }
  return matrix;
}

VectorXd CommonDenominator::denominator(int order) const {
  MatrixXd reduced = MatrixXd::Zero(order + 1, order + 1);
  for (const Sums& sums : sums_) {
    const MatrixXd mixed = mixed_matrix(sums, order);
    const MatrixXd inputs = inputs_matrix(sums, order);
    const VectorXd unit = inputs.diagonal().cwiseSqrt().cwiseInverse();
    const MatrixXd scaled = unit.asDiagonal() * inputs * unit.asDiagonal();
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
    decomposition.setThreshold(kRankTolerance);
    decomposition.compute(scaled);
    const MatrixXd scaled_mixed = unit.asDiagonal() * mixed;
    reduced +=
        block(sums, 0, 0, order) - scaled_mixed.transpose() * decomposition.solve(scaled_mixed);
  }
  VectorXd a(order + 1);
  a(0) = 1.0;
  a.tail(order) = solve(reduced.bottomRightCorner(order, order), -reduced.col(0).tail(order));
  return a;
}

DenominatorPoles CommonDenominator::poles(int order) const {
  const VectorXd a = denominator(order);
  // Roots of 1 + a_1 z + ... are the inverses of those of w^n + a_1 w^(n-1) + ... + a_n.
  MatrixXd companion = MatrixXd::Zero(order, order);
  companion.row(0) = -a.tail(order).transpose();
  companion.diagonal(-1).setOnes();
  const Eigen::VectorXcd w = companion.eigenvalues();
  DenominatorPoles poles;
  poles.z = w.cwiseInverse();
  poles.residues.resize(static_cast<Index>(equations_.size()), order);
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    const VectorXd b = solve(inputs_matrix(sums_[e], order), mixed_matrix(sums_[e], order) * a);
    poles.residues.row(static_cast<Index>(e)) =
        polynomial(b.head(order + 1), poles.z.array()).matrix().transpose();
  }
  return poles;
}

}  // namespace flexarm::measured
