#include "assumed_modes/ritz.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

namespace flexarm::assumed_modes {

namespace {

constexpr Real kShift = 500;

/// The pencil in coordinates in which row k of `lumped`, in the order of weight, has its first
/// k + 1 entries only.
struct Rotated {
  SymmetricPencil pencil;  ///< strain and gravity together in `gravity`
  Matrix rotation;         ///< q = rotation q_rotated
};

Rotated rotated(const SymmetricPencil& pencil) {
  const Eigen::Index n = pencil.size();
  Rotated result{pencil, Matrix::Identity(n, n)};
  auto& lumped = result.pencil.lumped;
  const auto weight = [](const Lumped& at) {
    return (at.stiffness + kShift * at.inertia) * at.row.squaredNorm();
  };
  std::erase_if(lumped, [&](const Lumped& at) { return weight(at) == 0; });
  std::ranges::sort(lumped, std::ranges::greater(), weight);

  Matrix stiffness = pencil.gravity.size() > 0 ? pencil.gravity : Matrix::Zero(n, n);
  stiffness.diagonal() += pencil.strain;
  if (!lumped.empty()) {
    Matrix rows(n, static_cast<Eigen::Index>(lumped.size()));
    for (Eigen::Index k = 0; k < rows.cols(); ++k) {
      rows.col(k) = lumped[static_cast<std::size_t>(k)].row;
    }
    const Eigen::HouseholderQR<Matrix> factors(rows);
    result.rotation = factors.householderQ() * result.rotation;
    const auto rotate = [&](Matrix matrix) -> Matrix {
      matrix.applyOnTheLeft(factors.householderQ().adjoint());
      matrix.applyOnTheRight(factors.householderQ());
      return matrix;
    };
    stiffness = rotate(stiffness);
    result.pencil.spread = rotate(pencil.spread);
    for (Eigen::Index k = 0; k < rows.cols(); ++k) {
      Vector& row = lumped[static_cast<std::size_t>(k)].row;
      row = Vector::Zero(n);
      const Eigen::Index filled = std::min(k + 1, n);
      row.head(filled) = factors.matrixQR().col(k).head(filled);
    }
  }
  result.pencil.strain = Vector::Zero(n);
  result.pencil.gravity = std::move(stiffness);
  return result;
}

/// Pairs at one shift; none where K + shift M is not positive definite.
struct Shifted {
  Vector nu;       ///< 1/(mu + shift), descending
  Matrix vectors;  ///< in rotated coordinates
  Real residual = 0;
  bool definite = false;
  bool converged = false;
};

Shifted solved(const SymmetricPencil& pencil, Real shift) {
  Matrix whole = pencil.gravity + shift * pencil.spread;
  for (const Lumped& at : pencil.lumped) {
    whole.selfadjointView<Eigen::Lower>().rankUpdate(at.row, at.stiffness + shift * at.inertia);
  }
  const Eigen::LLT<Matrix> factor(whole);
  Shifted result;
  result.definite = factor.info() == Eigen::Success;
  if (!result.definite) return result;
  const auto lower = factor.matrixL();
  const Matrix half = lower.solve(pencil.spread);
  Matrix inverse = lower.solve(half.transpose());
  for (const Lumped& at : pencil.lumped) {
    inverse.selfadjointView<Eigen::Lower>().rankUpdate(lower.solve(at.row), at.inertia);
  }
  inverse = Matrix(inverse.selfadjointView<Eigen::Lower>());

  const Eigen::SelfAdjointEigenSolver<Matrix> solver(inverse);
  result.nu = solver.eigenvalues().reverse();
  const Matrix vectors = solver.eigenvectors().rowwise().reverse();
  result.residual =
      (inverse * vectors - vectors * result.nu.asDiagonal()).colwise().norm().maxCoeff() /
      result.nu(0);
  result.vectors = factor.matrixU().solve(vectors);
  result.converged = solver.info() == Eigen::Success && result.nu.minCoeff() > 0;
  return result;
}

/// mu of the vector q, its terms added apart.
Real rayleigh_quotient(const SymmetricPencil& pencil, const Vector& q) {
  Real stiffness = q.cwiseAbs2().dot(pencil.strain);
  if (pencil.gravity.size() > 0) stiffness += q.dot(pencil.gravity * q);
  Real mass = q.dot(pencil.spread * q);
  for (const Lumped& at : pencil.lumped) {
    const Real square = at.row.dot(q) * at.row.dot(q);
    stiffness += at.stiffness * square;
    mass += at.inertia * square;
  }
  return stiffness / mass;
}

/// The lowest pair's vector after a step of inverse iteration without shift, K q' = M q, which
/// takes out what rounding has left of the others in it.
Vector iterated(const SymmetricPencil& pencil, const Vector& q) {
  Vector momentum = pencil.spread * q;
  for (const Lumped& at : pencil.lumped) momentum += at.inertia * at.row.dot(q) * at.row;
  const Vector next = Eigen::LDLT<Matrix>(pencil.stiffness()).solve(momentum);
  return next * (q.norm() / next.norm()) * (next.dot(q) < 0 ? -1 : 1);
}

}  // namespace

RitzPairs ritz_pairs(const SymmetricPencil& pencil) {
  const Rotated in = rotated(pencil);
  constexpr Real kLargestShift = 1e12L;
  Real shift = kShift;
  Shifted found = solved(in.pencil, shift);
  // Far enough below the lowest eigenvalue: mu + shift is a quarter of the shift at least.
  while (!found.definite || found.nu(0) * shift > 4) {
    shift *= 4;
    if (shift > kLargestShift) throw std::logic_error("stiffness without a lower bound");
    found = solved(in.pencil, shift);
  }

  RitzPairs pairs;
  pairs.vectors = in.rotation * found.vectors;
  pairs.largest_residual = found.residual;
  pairs.converged = found.converged;
  pairs.mass = found.nu;
  pairs.eigenvalues = found.nu.cwiseInverse().array() - shift;
  constexpr Real kVeryLow = 1e-9L;
  if (std::abs(pairs.eigenvalues(0)) < kVeryLow * shift) {
    pairs.vectors.col(0) = iterated(pencil, pairs.vectors.col(0));
  }
  for (Eigen::Index k = 0; k < pencil.size() && pairs.eigenvalues(k) < shift; ++k) {
    pairs.eigenvalues(k) = rayleigh_quotient(pencil, pairs.vectors.col(k));
  }
  pairs.stiffness = pairs.eigenvalues.cwiseProduct(pairs.mass);
  return pairs;
}

}  // namespace flexarm::assumed_modes
