#pragma once

#include "assumed_modes/real.hpp"
#include "assumed_modes/symmetric_pencil.hpp"

namespace flexarm::assumed_modes {

enum class Wanted {
  pairs,
  values,  ///< vectors and residual are left out, but where the lowest eigenvalue needs them
};

/// Solutions of K q = mu M q, mu = lambda^4 = m l^4 omega^2/EI, in ascending order.
struct RitzPairs {
  Vector eigenvalues;         ///< mu
  Vector mass;                ///< q^T M q
  Vector stiffness;           ///< q^T K q = mu q^T M q; stiffness + shift mass = 1
  Matrix vectors;             ///< columns q
  Real largest_residual = 0;  ///< of the lowest twelve, |C z - nu z| over the largest nu
  bool converged = false;     ///< the eigensolver did, and every q^T M q is positive
};

/// All pairs of the pencil; M positive definite, K of any sign.
///
/// With a shift S = K + shift M = L L^T and q = L^-T z the problem is C z = nu z,
/// C = L^-1 M L^-T and nu = 1/(mu + shift): low frequencies are the large eigenvalues and the
/// accurate ones, off by the unit of rounding times mu/shift. The shift, 500 or what makes S
/// positive definite, is of the size of a beam's first eigenvalues. Below it mu is the Rayleigh
/// quotient of its vector, whose error is the square of the vector's: a pendulum's or a soft root's
/// frequency may be as low as it pleases and has all its digits (the lowest vector, where it lies
/// far below the shift, after a step of inverse iteration). Lumped terms are rotated into the
/// first coordinates, the greatest first, where Cholesky's method leaves their rounding: whatever
/// their size, they do not drown the beam.
RitzPairs ritz_pairs(const SymmetricPencil& pencil, Wanted wanted = Wanted::pairs);

}  // namespace flexarm::assumed_modes
