#pragma once

#include "fem/discretisation.hpp"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace flexarm::fem {

/// Finite roots of the Rosenbrock pencil of hub torque to the reading c^T u, as values of
/// w = s^2, dimensionless:
///
///     [K + w M   -e0] [u  ]
///     [c^T        0 ] [tau] = 0.
///
/// At w = 0 the pencil is solved by statics and kinematics alone: the loads bend the clamped arm,
/// then the arm turns rigidly until c^T u = 0, which is possible since c^T r != 0.
struct PencilRoots {
  std::vector<std::complex<double>> w;  ///< ascending in |w|; of a conjugate pair that with Im > 0
  int newton_steps = 0;
  bool converged = true;
  double largest_step = 0.0;  ///< largest last Newton step, relative to |w|
};

/// The `count` roots smallest in |w| (a conjugate pair counts as two and is not parted). First
/// guesses are eigenvalues of the inverse pencil at w = 0: of the dense matrix for a small model,
/// else by Spectra's Arnoldi iteration to `tolerance`. The eigenproblem is far from normal (its
/// n-th real root has a condition of about exp(n pi)), so each guess is then polished by Newton's
/// method on
///
///     N(w) = F(w) prod_i (1 + w/omega_i^2),   F(w) = c^T u(w) for theta = 1,
///
/// with omega_i the frequencies of the arm with the hub clamped, at which F has its poles. Roots
/// already found are divided out (Maehly), so that no two guesses end in one root.
PencilRoots pencil_roots(const Discretisation& discretisation, const Eigen::VectorXd& c, int count,
                         double tolerance);

/// Where Newton's method on F goes from `w`.
struct FollowedRoot {
  std::complex<double> w;
  bool converged = false;
  int newton_steps = 0;
  double last_step = 0.0;  ///< relative to |w|
};
FollowedRoot follow_root(const Discretisation& discretisation, const Eigen::VectorXd& c,
                         std::complex<double> w);

/// How many roots lie in |w| < `radius`, conjugates counted apart: the turns of N(w) around that
/// circle (argument principle). Returns -1 when the turns cannot be told.
int roots_inside(const Discretisation& discretisation, const Eigen::VectorXd& c, double radius,
                 double tolerance);

}  // namespace flexarm::fem
