#include "assumed_modes/quadratic_pencil.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::assumed_modes {

namespace {

using Complex = std::complex<Real>;
using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

/// T(s) and T'(s): the pencil, or for an arm that turns freely the one in (v_0, q_1, ...) with its
/// first row divided by s, which has the same roots but s = 0.
struct Value {
  ComplexMatrix value;
  ComplexMatrix derivative;
};

Value value_at(const QuadraticPencil& pencil, Complex s) {
  Value result{s * pencil.damping.cast<Complex>(), pencil.damping.cast<Complex>()};
  result.value.diagonal() += s * s * pencil.mass.cast<Complex>() + pencil.stiffness.cast<Complex>();
  result.derivative.diagonal() += Complex(2) * s * pencil.mass.cast<Complex>();
  if (!pencil.turns_freely()) return result;
  const Eigen::Index flexible = pencil.mass.size() - 1;
  const auto damping = pencil.damping.col(0).cast<Complex>();
  result.value.row(0) = damping.transpose();
  result.value.col(0) = damping;
  result.value(0, 0) = pencil.mass(0) + damping(0) / s;
  result.derivative.row(0).tail(flexible).setZero();
  result.derivative.col(0).tail(flexible).setZero();
  result.derivative(0, 0) = -damping(0) / (s * s);
  return result;
}

}  // namespace

QuadraticPencil QuadraticPencil::scaled(Real tau) const {
  const Vector size = (mass * (tau * tau) + stiffness.cwiseAbs()).cwiseSqrt().cwiseInverse();
  return {mass.cwiseProduct(size).cwiseProduct(size),
          stiffness.cwiseProduct(size).cwiseProduct(size),
          size.asDiagonal() * damping * size.asDiagonal()};
}

Real shift_of(const QuadraticPencil& pencil) {
  const Real lowest = pencil.stiffness(0) / pencil.mass(0);
  const Real flexible = pencil.stiffness(1) / pencil.mass(1);
  return std::sqrt(std::max(flexible, -4 * lowest));
}

std::vector<std::complex<double>> all_roots(const QuadraticPencil& pencil, Real tau,
                                            Real damping_factor) {
  const Eigen::Index n = pencil.mass.size();
  const Eigen::Index freed = pencil.turns_freely() ? 1 : 0;
  const Eigen::Index held = n - freed;
  const Matrix damping = damping_factor * pencil.damping;
  Matrix value = tau * damping;
  value.diagonal() += tau * tau * pencil.mass + pencil.stiffness;
  Matrix derivative = damping;
  derivative.diagonal() += 2 * tau * pencil.mass;
  if (pencil.turns_freely()) {
    value(0, 0) = tau * pencil.mass(0) + damping(0, 0);
    value.col(0).tail(held) = damping.col(0).tail(held);
    derivative(0, 0) = pencil.mass(0);
    derivative.col(0).tail(held).setZero();
  }
  // w value q = -derivative q - root r,   w r = root^T q,   root root^T = diag(mass).
  Matrix right = Matrix::Zero(n, n + held);
  right.leftCols(n) = derivative;
  right.bottomRightCorner(held, held) = pencil.mass.tail(held).cwiseSqrt().asDiagonal();
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n + held, n + held);
  companion.topRows(n) = -Eigen::PartialPivLU<Matrix>(value).solve(right).cast<double>();
  companion.block(n, freed, held, held) =
      pencil.mass.tail(held).cwiseSqrt().cast<double>().asDiagonal();

  const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
  std::vector<std::complex<double>> roots;
  for (const std::complex<double>& w : solver.eigenvalues()) {
    roots.push_back(static_cast<double>(tau) + 1.0 / w);
  }
  return roots;
}

PolishedRoot polished(const QuadraticPencil& pencil, std::complex<Real> start) {
  constexpr int kMostSteps = 8;
  constexpr Real kEnough = 16 * std::numeric_limits<Real>::epsilon();
  PolishedRoot root{start, std::numeric_limits<Real>::infinity()};
  Eigen::VectorXcd vector = Eigen::VectorXcd::Ones(pencil.mass.size());
  for (int step = 0; step < kMostSteps && root.last_step > kEnough; ++step) {
    const auto [value, derivative] = value_at(pencil, root.s);
    // x^T T x is stationary at the vector: 53 bits of it are enough for 64 of the root.
    const Eigen::PartialPivLU<Eigen::MatrixXcd> factors(value.cast<std::complex<double>>());
    const Eigen::MatrixXcd right = derivative.cast<std::complex<double>>();
    vector = factors.solve(vector).normalized();
    vector = factors.solve(right * vector).normalized();
    if (!vector.allFinite()) break;  // T(s) is singular to the last bit
    const ComplexVector exact = vector.cast<Complex>();
    const Complex change =
        exact.cwiseProduct(value * exact).sum() / exact.cwiseProduct(derivative * exact).sum();
    root.s -= change;
    root.last_step = std::abs(change) / std::abs(root.s);
  }
  return root;
}

}  // namespace flexarm::assumed_modes
