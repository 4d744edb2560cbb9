#pragma once

#include "fem/discretisation.hpp"
#include "fem/pole_free_numerator.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace flexarm::fem {

/// Finite roots of the Rosenbrock pencil of hub torque to the reading c(w)^T u, as values of
/// w = s^2, dimensionless:
///
///     [K + w M   -e0] [u  ]
///     [c(w)^T     0 ] [tau] = 0.
///
/// Without weight the pencil is solved at w = 0 by statics and kinematics alone: the loads bend the
/// clamped arm, then the arm turns rigidly until c^T u = 0, which is possible since c^T r != 0.
/// With weight it is solved at the shift of FlexibleSolve, by the response of the clamped arm to
/// loads and that to unit hub rotation.
struct PencilRoots {
  std::vector<std::complex<double>> w;  ///< ascending in |w|; of a conjugate pair that with Im > 0
  int newton_steps = 0;
  bool converged = false;
  double largest_step = 0.0;  ///< largest last Newton step, relative to |w|
};

/// The `count` roots smallest in |w| (a conjugate pair counts as two and is not parted); a few more
/// where they were found on the way. First guesses are eigenvalues of the inverse pencil there:
/// of the dense matrix for a small model, else by Spectra's Arnoldi iteration to `tolerance`. The
/// eigenproblem is far from normal (its n-th real root has a condition of about exp(n pi)), so each
/// guess is polished by Newton's method on the numerator, with the roots already found divided
/// out. Last searches from three more places, repeated until none ends inside the largest root
/// found, bring in those that the guesses missed. Throws std::runtime_error, which names the model,
/// when an eigensolver breaks down.
PencilRoots pencil_roots(const Discretisation& discretisation, const PoleFreeNumerator& numerator,
                         int count, double tolerance);

/// Searches for a root that is missing beside roots.w[k] in |w|: nearer to it (in ratio) than the
/// known neighbours on either side. Newton's method starts from points all around that ring and
/// divides out the known roots; whatever it finds is added to `roots`. True once it found one in
/// the ring.
bool search_beside(std::size_t k, const PoleFreeNumerator& numerator, PencilRoots& roots);

}  // namespace flexarm::fem
