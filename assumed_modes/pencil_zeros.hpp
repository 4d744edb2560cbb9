#pragma once

#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/decaying_functions.hpp"
#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"

#include <complex>
#include <vector>

namespace flexarm::assumed_modes {

/// Roots of a discrete zero problem.
struct PencilZeros {
  /// (s/omega_scale)^2, those at the origin and at infinity left out; one of each conjugate pair.
  std::vector<std::complex<Real>> sigma_squared;
  int infinite = 0;  ///< infinite eigenvalues of the Rosenbrock pencil
  bool converged = false;
};

/// Zeros of hub torque to the output b, of an arm whose drive is rigid: sigma^2 at which the
/// Rosenbrock pencil
///
///     [ K + sigma^2 M   -a ]
///     [ b^T              0 ]
///
/// is singular, a the row of the hub's rotation. The null space of a^T on the left and of b^T on
/// the right reduce it to a pencil R_K + sigma^2 R_M of order n - 1, from which hub inertia and hub
/// spring are gone, and that to an ordinary eigenproblem: infinite roots become eigenvalues 0.
///
/// - An output that sees the rigid rotation gives q_0 by the others; the eigenvalues of
///   R_K^-1 R_M are -1/sigma^2.
/// - One that does not, on an arm whose stiffness does not see the rotation either, has a
///   decoupling zero at the origin, which is deflated exactly.
/// - Gravity moves that zero off the origin, near it when weak: the eigenvalues of
///   (R_K + sigma_0^2 R_M)^-1 R_M are 1/(sigma_0^2 - sigma^2).
///
/// `tip_is_held`: b is the tip's displacement, so that a zero keeps the tip still and the payload's
/// mass acts by its centre's rotation about the tip alone; left in, its product with the tip's
/// displacement would cancel.
PencilZeros pencil_zeros(const AdmissibleFunctions& functions, const ScaledArm& arm,
                         const Vector& output, bool tip_is_held);

/// The same of the pencil in functions that decay from the hub and test functions that grow.
/// `shift` is sigma_0^2, at which the pencil is factorised.
PencilZeros pencil_zeros(const DecayingPencil& pencil, Real shift);

}  // namespace flexarm::assumed_modes
