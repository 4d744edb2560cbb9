#pragma once

#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"
#include "assumed_modes/strain_functions.hpp"

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::assumed_modes {

/// The decay exp(-w(xi)), its rate w' linear along the beam.
struct Decay {
  Real rate_at_root = 0;
  Real rise = 0;           ///< of the rate, from root to tip
  Real sigma_squared = 0;  ///< at which solutions of the arm decay like this

  Decay reversed() const { return {-rate_at_root, -rise, sigma_squared}; }
};

/// The mean rate at which the arm's bending waves of frequency s [omega scale] decay: on a beam
/// with the tension P(xi), solutions exp(-rho xi) have rho^4 - P rho^2 + s^2 = 0, and what is
/// smaller of the two |Re rho| is what reaches the tip. 0 on the imaginary axis.
Real mean_decay(const ScaledArm& arm, std::complex<Real> s);

/// The decay of mean rate r, fitted to that of the arm's bending waves at the real s of that mean.
Decay decay_of(const ScaledArm& arm, Real mean_rate);

/// Strain functions times exp(-w): y = exp(-w) p with p from the displacements of
/// `StrainFunctions`. All values below are without the exponential,
///
///     displacement p,   slope (d - w') p,   rotation (d - w') p,   curvature (d - w')^2 p,
///
/// d the derivative; the functions of shear have no rotation, and (d - w') p is their shear strain.
/// The function of the hub is p = a + (1 + w'(0) a) xi, so that hub and root turn by 1 together.
///
/// Functions of springs softer than the beam, k < 1, are those of the strain functions times
/// sqrt(k), so that they are no larger than the others. Where the root is as soft as that, the
/// function of the hub turns the hub alone: p = a (1 + w'(0) xi), psi(0) = 0. Hub and root turning
/// together are nearly the function of the root there.
///
/// A product of functions of the decays w and -w has no exponential left: its integral is that of
/// the polynomials.
class DecayingFunctions {
 public:
  /// The arm's drive must be rigid (`beyond_drive`).
  DecayingFunctions(const StrainFunctions& functions, const ScaledArm& arm, const Decay& decay);

  Vector displacement(Real xi) const;
  Vector rotation(Real xi) const;
  Vector curvature(Real xi) const;

  /// Legendre series of every function on one piece.
  struct Piece {
    Real start = 0;
    Real length = 0;
    Matrix displacement;
    Matrix slope;
    Matrix rotation;
    Matrix curvature;
    Matrix shear;  ///< strain; empty on a beam that bends only
  };
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Of `k`, an entry of the arm's `carried`.
  Vector extension(std::size_t k) const;
  /// Strain energy of the springs at root, crack and suspensions, in test functions of the opposite
  /// decay that hold the hub; their rows only.
  Matrix spring_energy() const;

 private:
  const Piece& piece_at(Real xi) const;

  std::vector<Piece> pieces_;
  std::vector<Vector> extensions_;
  Vector spring_scale_;  ///< of functions that stand for a spring, sqrt(k) at most 1; 0 of others
  Real hub_turn_at_root_ = 0;  ///< kr times the jump at a soft root of the function of the hub
};

/// A mass or an inertia, inertia left right^T, on one displacement or rotation of the beam: its
/// values in test and trial functions.
struct DecayingLump {
  Vector left;
  Vector right;
  Real inertia = 0;
};

/// What is left of Lagrange's equations, (K + sigma^2 M) q = a tau, in trial functions of the decay
/// w and test functions of the decay -w that hold the hub: no torque, hub inertia or hub spring
/// enters. (n - 1) x n; rows are test functions. M is `spread` and the lumps.
struct DecayingPencil {
  Matrix stiffness;
  Matrix spread;
  std::vector<DecayingLump> lumped;
  Vector output;  ///< b in the trial functions
};

/// b is the curvature at `strain_at`, or else the displacement of the tip, which a zero holds: the
/// payload's mass then acts by its centre's rotation about the tip alone.
DecayingPencil decaying_pencil(const StrainFunctions& functions, const ScaledArm& arm,
                               const Decay& decay, std::optional<Real> strain_at);

}  // namespace flexarm::assumed_modes
