#pragma once

#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"

#include <cstddef>
#include <vector>

namespace flexarm::assumed_modes {

/// How many functions a beam that is whole and bends only is given, and how many more each family
/// on each piece gets.
struct StrainFunctionCount {
  int on_whole_beam = 1;  ///< N, 1 or more
  int more = 0;
};

/// Admissible functions given by their strains: one strain at a time, the others zero, and y and
/// psi follow by integration from the hub. In units of l, they are
///
///     the rigid rotation     y = a + xi, psi = 1, rotor and hub 1: no strain
///     the drive              y = (a + xi)/sqrt(kd), psi and hub 1/sqrt(kd), the rotor at rest
///     the soft root          psi = 1/sqrt(kr) behind it
///     the crack              psi = 1/sqrt(kc) behind it
///     a suspended mass       its displacement is 1/sqrt(kk): y = psi = 0
///     bending of a piece     psi' = orthonormal Legendre polynomial there, zero elsewhere
///     shear of a piece       y' - psi = orthonormal Legendre polynomial over sqrt(k G A)
///
/// in this order, each present where the arm has what it stands for; the beam is one piece, or
/// several that meet at crack and masses. In all but its own function a suspended mass moves with
/// the beam. The strain energy matrix is diag(0, 1, ..., 1): a beam that is stiff in
/// shear cannot lock, for y' = psi is among the functions. Every end value is left free and every
/// solution is smooth on each piece, so that Ritz values converge faster than any power.
///
/// A piece of length h gets c + ceil((N - c) h) functions of each family, c = min(N, 14):
/// polynomials resolve waves in proportion to the length, and need some to begin with. Spaces grow
/// with N.
class StrainFunctions {
 public:
  /// Legendre series of every function on one piece.
  struct Piece {
    Real start = 0;
    Real length = 0;
    Matrix displacement;
    Matrix slope;
    Matrix rotation;
    Matrix curvature;
  };

  StrainFunctions(const ScaledArm& arm, StrainFunctionCount count);

  Eigen::Index size() const { return bends_.size(); }
  /// 1 where the strain energy of a function is bending, 0 for the rotation, springs and shear.
  const Vector& bends() const { return bends_; }
  /// theta_m, on which the torque acts; theta.
  Vector motor_rotation() const { return Vector::Unit(size(), 0); }
  const Vector& hub_rotation() const { return hub_rotation_; }
  Vector displacement(Real xi) const;
  Vector rotation(Real xi) const;
  /// psi'; where pieces meet that on the side of the tip.
  Vector curvature(Real xi) const;
  /// The displacement of a mass on the beam, that of `carried`'s entry k.
  Vector carried_displacement(std::size_t k) const;
  /// How far it is from its place on the beam; zero where it is fixed.
  Vector extension(std::size_t k) const;

  /// int y_i y_j.
  Matrix displacement_products() const;
  /// int psi_i psi_j.
  Matrix rotation_products() const;
  /// int p y_i' y_j' with p = arm.tension.
  Matrix slope_products(const ScaledArm& arm) const;

  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Number of the first function of shear; `size()` on a beam that bends only.
  Eigen::Index first_of_shear() const { return first_of_shear_; }

 private:
  const Piece& piece_at(Real xi) const;

  /// A mass on the beam: where, and which function is its suspension's, with what value.
  struct Carried {
    Real position = 0;
    Eigen::Index function = -1;  ///< -1 where it is fixed
    Real extension = 0;
  };

  std::vector<Piece> pieces_;
  std::vector<Carried> carried_;
  Vector bends_;
  Vector hub_rotation_;
  Eigen::Index first_of_shear_ = 0;
};

}  // namespace flexarm::assumed_modes
