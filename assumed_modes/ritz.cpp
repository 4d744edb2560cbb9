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
  Matrix stiffness;  ///< strain and gravity
  Matrix spread;
  std::vector<Lumped> lumped;
  Matrix rotation;  ///< q = rotation q_rotated; empty where nothing is turned
};

Rotated rotated(const SymmetricPencil& pencil) {
  const Eigen::Index n = pencil.size();
  Rotated result{Matrix::Zero(n, n), pencil.spread, pencil.lumped, {}};
  if (pencil.gravity.size() > 0) result.stiffness = pencil.gravity;
  result.stiffness.diagonal() += pencil.strain;

  // Ten times what is spread costs a digit at most.
  constexpr Real kHeavy = 10;
  auto& lumped = result.lumped;
  const auto weight = [](const Lumped& at) {
    return (at.stiffness + kShift * at.inertia) * at.row.squaredNorm();
  };
  std::erase_if(lumped, [&](const Lumped& at) { return weight(at) == 0; });
  std::ranges::sort(lumped, std::ranges::greater(), weight);
  const Real spread = pencil.strain.maxCoeff() + kShift * pencil.spread.diagonal().maxCoeff();
  if (lumped.empty() || weight(lumped.front()) <= kHeavy * spread) return result;

  Matrix rows(n, static_cast<Eigen::Index>(lumped.size()));
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    rows.col(k) = lumped[static_cast<std::size_t>(k)].row;
  }
  const Eigen::HouseholderQR<Matrix> factors(rows);
  const auto rotate = [&](Matrix& matrix) {
    matrix.applyOnTheLeft(factors.householderQ().adjoint());
    matrix.applyOnTheRight(factors.householderQ());
  };
  rotate(result.stiffness);
  rotate(result.spread);
  result.rotation = factors.householderQ();
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    Vector& row = lumped[static_cast<std::size_t>(k)].row;
    row = Vector::Zero(n);
    const Eigen::Index filled = std::min(k + 1, n);
    row.head(filled) = factors.matrixQR().col(k).head(filled);
  }
  return result;
}

/// Pairs at one shift; none where K + shift M is not positive definite.
struct Shifted {
  Vector nu;       ///< 1/(mu + shift), descending
  Matrix vectors;  ///< in rotated coordinates; empty where values alone were asked for
  Real residual = 0;
  bool definite = false;
  bool converged = false;
};

Shifted solved(const Rotated& pencil, Real shift, bool with_vectors) {
  Matrix whole = pencil.stiffness + shift * pencil.spread;
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

  const Eigen::SelfAdjointEigenSolver<Matrix> solver(
      inverse, with_vectors ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly);
  result.nu = solver.eigenvalues().reverse();
  result.converged = solver.info() == Eigen::Success && result.nu.minCoeff() > 0;
  if (!with_vectors) return result;
  constexpr Eigen::Index kLowest = 12;
  const Matrix vectors = solver.eigenvectors().rowwise().reverse();
  const auto shown = vectors.leftCols(std::min(kLowest, vectors.cols()));
  result.residual = (inverse * shown - shown * result.nu.head(shown.cols()).asDiagonal())
                        .colwise()
                        .norm()
                        .maxCoeff() /
                    result.nu(0);
  result.vectors = factor.matrixU().solve(vectors);
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

RitzPairs ritz_pairs(const SymmetricPencil& pencil, Wanted wanted) {
  const Rotated in = rotated(pencil);
  const bool with_vectors = wanted == Wanted::pairs;
  constexpr Real kLargestShift = 1e12L;
  Real shift = kShift;
  Shifted found = solved(in, shift, with_vectors);
  // Far enough below the lowest eigenvalue: mu + shift is a quarter of the shift at least.
  while (!found.definite || found.nu(0) * shift > 4) {
    shift *= 4;
    if (shift > kLargestShift) throw std::logic_error("stiffness without a lower bound");
    found = solved(in, shift, with_vectors);
  }

  RitzPairs pairs;
  pairs.largest_residual = found.residual;
  pairs.converged = found.converged;
  pairs.mass = found.nu;
  pairs.eigenvalues = found.nu.cwiseInverse().array() - shift;
  if (with_vectors) {
    pairs.vectors = in.rotation.size() > 0 ? Matrix(in.rotation * found.vectors) : found.vectors;
    constexpr Real kVeryLow = 1e-9L;
    if (std::abs(pairs.eigenvalues(0)) < kVeryLow * shift) {
      pairs.vectors.col(0) = iterated(pencil, pairs.vectors.col(0));
    }
    for (Eigen::Index k = 0; k < pencil.size() && pairs.eigenvalues(k) < shift; ++k) {
      pairs.eigenvalues(k) = rayleigh_quotient(pencil, pairs.vectors.col(k));
    }
  } else {
    // The difference has lost a thousand units of rounding where it is a thousandth of the shift.
    constexpr Real kLow = 1e-3L;
    if (pairs.eigenvalues.cwiseAbs().minCoeff() < kLow * shift) {
      return ritz_pairs(pencil, Wanted::pairs);
    }
  }
  pairs.stiffness = pairs.eigenvalues.cwiseProduct(pairs.mass);
  return pairs;
}

}  // namespace flexarm::assumed_modes
