#pragma once

#include "assumed_modes/mass_matrix.hpp"
#include "assumed_modes/output_row.hpp"
#include "assumed_modes/real.hpp"

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

/// Zeros of hub torque to `output`: sigma^2 at which the Rosenbrock pencil
///
///     [ K + sigma^2 M   -a ]
///     [ b^T              0 ]
///
/// is singular, a = (1, root_slope), b = `output`, K = diag(0, I). The null space of a^T on the
/// left and of b^T on the right reduce it to an ordinary eigenproblem of order n - 1 for
/// -1/sigma^2: infinite roots become eigenvalues 0. An output that does not see the rigid rotation
/// has a decoupling zero at the origin, which is deflated exactly.
///
/// `mass` must be without the hub inertia and, for the tip's displacement, may be without the
/// payload mass: a zero holds those still.
PencilZeros pencil_zeros(const MassMatrix& mass, const Vector& root_slope, const OutputRow& output);

}  // namespace flexarm::assumed_modes
