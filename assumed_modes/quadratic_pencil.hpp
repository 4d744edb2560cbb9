#pragma once

#include "assumed_modes/real.hpp"

#include <complex>
#include <vector>

namespace flexarm::assumed_modes {

/// s^2 diag(mass) + s damping + diag(stiffness), the damped arm in n modes of the undamped one,
/// each scaled as it pleases. mass > 0; damping symmetric and positive semidefinite; stiffness(0)
/// may be 0, for an arm that turns freely, or below 0, for one that falls; the others are above 0.
struct QuadraticPencil {
  Vector mass;
  Vector stiffness;
  Matrix damping;

  bool turns_freely() const { return stiffness(0) == 0; }
  /// The modes scaled so that mass tau^2 + |stiffness| = 1 for each.
  QuadraticPencil scaled(Real tau) const;
};

/// A shift to the right of every root, near the lowest of them in size: the pencil there is
/// positive definite. n >= 2.
Real shift_of(const QuadraticPencil& pencil);

/// All roots with `damping_factor` times the damping, to double precision; the root at s = 0 of an
/// arm that turns freely is left out once, so that 2 n or 2 n - 1 are returned.
///
/// With s = tau + 1/w the pencil is w^2 P(tau) + w P'(tau) + diag(mass): low roots are large
/// eigenvalues w of its companion matrix, and stay accurate beside frequencies that are 1e6 times
/// as high. An arm that turns freely is written in its velocity v_0 = s q_0, which leaves out s =
/// 0.
///
/// `pencil` must be scaled for `tau`.
std::vector<std::complex<double>> all_roots(const QuadraticPencil& pencil, Real tau,
                                            Real damping_factor);

/// A root after Newton's method.
struct PolishedRoot {
  std::complex<Real> s;
  Real last_step = 0;  ///< relative to |s|
};

/// The root near `start`, by Newton's method on x^T T(s) x with x by inverse iteration: T is
/// symmetric, so that x is the left vector as well. A real start stays real. start != 0.
PolishedRoot polished(const QuadraticPencil& pencil, std::complex<Real> start);

}  // namespace flexarm::assumed_modes
