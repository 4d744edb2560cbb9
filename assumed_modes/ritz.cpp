#include "assumed_modes/ritz.hpp"

#include <Eigen/Eigenvalues>

namespace flexarm::assumed_modes {

RitzPairs ritz_pairs(const Matrix& mass) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(mass);
  RitzPairs pairs;
  const Vector inverse = solver.eigenvalues().reverse();
  pairs.converged = solver.info() == Eigen::Success && (inverse.array() > 0).all();
  pairs.vectors = solver.eigenvectors().rowwise().reverse();
  pairs.eigenvalues = inverse.cwiseInverse();
  pairs.largest_residual =
      (mass * pairs.vectors - pairs.vectors * inverse.asDiagonal()).colwise().norm().maxCoeff() /
      inverse(0);
  return pairs;
}

Matrix clamped_root_mass(const MassMatrix& mass, const Vector& root_slope) {
  const Matrix cross = mass.coupling * root_slope.transpose();
  return mass.flexible - cross - cross.transpose() +
         mass.rigid * root_slope * root_slope.transpose();
}

}  // namespace flexarm::assumed_modes
