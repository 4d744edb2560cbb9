#pragma once

#include "fem/discretisation.hpp"
#include "fem/flexible_solve.hpp"

#include <Eigen/Core>

namespace flexarm::fem {

/// The lowest modes of K u = omega^2 M u, dimensionless: the flexible ones, and with a free hub the
/// one below them.
struct VibrationModes {
  double lowest_omega_squared = 0.0;  ///< of the mode below the flexible ones; 0 where clamped
  Deformed lowest;                    ///< its shape, u^T M u = 1; empty where clamped
  Eigen::VectorXd omega_squared;      ///< ascending
  Eigen::MatrixXd shapes;             ///< n x count, u^T M u = 1; row 0 is u(0) (0 where clamped)
  Eigen::MatrixXd deformations;       ///< (n - 1) x count, the natural ones
  int iterations = 0;                 ///< operator applications of the iterative solver, else 0
  /// largest_change <= max(1e-8, tolerance).
  bool converged = false;
  bool dense = false;  ///< by singular values of the whole factored problem
  /// Largest relative change of an omega^2 at the last refinement.
  double largest_change = 0.0;
};

/// Whichever is faster for the size; the others are for comparison (benchmarks/fem_benchmark.cpp).
enum class Eigensolver { by_size, dense, lanczos };

/// The `count` lowest flexible modes, all of them where there are fewer. Of a small model (or when
/// nearly all modes are asked for) they come from a dense problem: 1/omega are the singular values
/// of D^-1/2 B^-T L with M = L L^T, or, where the solution is shifted (see FlexibleSolve),
/// 1/(omega^2 + shift) the eigenvalues of L^T (K + shift M)^-1 L. Else Spectra's Lanczos iteration
/// finds 1/(omega^2 + shift) to `tolerance` (Spectra's residual bound
/// |r| <= tolerance max(eps^(2/3), 1/(omega^2 + shift))). The rigid-body mode of a hub that turns
/// freely is projected out, and so are modes that are far slower than the rest (see slow_modes).
/// Each mode is then refined by inverse iteration, orthogonal to those below it, and omega^2 = u^T
/// K u/u^T M u is summed in element deformations. Throws std::runtime_error, which names the model,
/// when an eigensolver breaks down or does not converge.
VibrationModes vibration_modes(const Discretisation& discretisation, HubSupport support, int count,
                               double tolerance, Eigensolver eigensolver = Eigensolver::by_size);

/// How many eigenvalues of K u = omega^2 M u lie below `omega_squared`, the lowest mode
/// included: negative pivots of L D L^T = K - omega^2 M (Sylvester's law of inertia). Returns -1
/// where rounding of K, about epsilon 12/h^4 of omega^2, could change the count.
int eigenvalues_below(const Discretisation& discretisation, HubSupport support,
                      double omega_squared);

}  // namespace flexarm::fem
