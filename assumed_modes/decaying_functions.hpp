#pragma once

#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"
#include "assumed_modes/strain_functions.hpp"

#include <vector>

namespace flexarm::assumed_modes {

/// Strain functions times exp(-r xi), r of either sign: y = exp(-r xi) p with p from the
/// displacements of `StrainFunctions`. All values below are without the exponential,
///
///     displacement p,   slope (d - r) p,   rotation (d - r) p,   curvature (d - r)^2 p,
///
/// d the derivative; the functions of shear have no rotation, and (d - r) p is their shear strain.
/// Jumps at root and crack and the suspensions' extensions are those of the strain functions. The
/// function of the hub is p = a + (1 + r a) xi, so that hub and root turn by 1 together.
///
/// A product of functions of the rates r and -r has no exponential left: its integral is that of
/// the polynomials.
class DecayingFunctions {
 public:
  /// The arm's drive must be rigid (`beyond_drive`).
  DecayingFunctions(const StrainFunctions& functions, const ScaledArm& arm, Real rate);

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

 private:
  const Piece& piece_at(Real xi) const;

  std::vector<Piece> pieces_;
};

/// A mass or an inertia, inertia left right^T, on one displacement or rotation of the beam: its
/// values in test and trial functions.
struct DecayingLump {
  Vector left;
  Vector right;
  Real inertia = 0;
};

/// What is left of Lagrange's equations, (K + sigma^2 M) q = a tau, in trial functions of the rate
/// r and test functions of the rate -r that hold the hub: no torque, hub inertia or hub spring
/// enters. (n - 1) x n; rows are test functions. M is `spread` and the lumps.
struct DecayingPencil {
  Matrix stiffness;
  Matrix spread;
  std::vector<DecayingLump> lumped;
};

/// `tip_is_held`: as for `pencil_zeros`.
DecayingPencil decaying_pencil(const StrainFunctions& functions, const ScaledArm& arm,
                               const DecayingFunctions& trial, Real rate, bool tip_is_held);

}  // namespace flexarm::assumed_modes
