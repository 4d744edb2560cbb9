#pragma once

#include "assumed_modes/mass_matrix.hpp"
#include "assumed_modes/real.hpp"

namespace flexarm::assumed_modes {

/// Solutions of q = mu M q for a symmetric positive definite M (the stiffness matrix is the
/// identity), mu = lambda^4 = m l^4 omega^2/EI.
struct RitzPairs {
  Vector eigenvalues;         ///< mu, ascending
  Matrix vectors;             ///< columns, orthonormal in strain energy: q^T q = 1
  Real largest_residual = 0;  ///< max over pairs of |M q - q/mu| mu_1
  bool converged = false;     ///< the eigensolver did, and every eigenvalue is positive
};

/// All pairs of `mass`. The large eigenvalues 1/mu of M are the accurate ones, and they are the
/// low frequencies.
RitzPairs ritz_pairs(const Matrix& mass);

/// Mass matrix of psi_i - xi psi_i'(0), the functions that keep the root from turning; its Ritz
/// values are the zeros of the hub angle. `mass` may be with or without hub inertia, which drops
/// out; without it nothing cancels.
Matrix clamped_root_mass(const MassMatrix& mass, const Vector& root_slope);

}  // namespace flexarm::assumed_modes
