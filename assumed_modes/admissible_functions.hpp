#pragma once

#include "assumed_modes/basis.hpp"
#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"
#include "assumed_modes/shape_functions.hpp"
#include "assumed_modes/strain_functions.hpp"

#include <cstddef>
#include <variant>

namespace flexarm::assumed_modes {

/// The functions of a basis, the rigid rotation first: y and psi in units of l and 1. The strain
/// energy matrix over EI/l is diag(0, 1, ..., 1).
class AdmissibleFunctions {
 public:
  /// `functions` generalised coordinates on a beam that is whole and bends only, the rotation
  /// included, 2 or more; each family of functions gets `more` on top. The arm must not have an
  /// effect that the basis cannot represent (assumed_modes/basis.hpp).
  AdmissibleFunctions(Basis basis, const ScaledArm& arm, int functions, int more = 0);

  Eigen::Index size() const;
  /// 1 where the strain energy is bending, 0 for the rotation, springs and shear.
  const Vector& bends() const;
  /// theta_m, on which the torque acts; theta.
  Vector motor_rotation() const;
  Vector hub_rotation() const;
  /// y, psi, psi' at xi in [0, 1].
  Vector displacement(Real xi) const;
  Vector rotation(Real xi) const;
  Vector curvature(Real xi) const;

  /// int y_i y_j.
  Matrix displacement_products() const;
  /// int psi_i psi_j, of an arm with shear.
  Matrix rotation_products() const;
  /// int p y_i' y_j' with p = arm.tension.
  Matrix slope_products(const ScaledArm& arm) const;

  /// Of the mass on the beam that is the arm's `carried` entry k: its displacement, and how far it
  /// is from its place on the beam. The basis must be able to represent it.
  Vector carried_displacement(std::size_t k) const;
  Vector extension(std::size_t k) const;
  /// psi(0) - theta of an arm whose root is compliant, theta - theta_m of one whose drive is.
  Vector root_turn() const;
  Vector drive_turn() const;

 private:
  std::variant<StrainFunctions, ShapeFunctions> functions_;
};

}  // namespace flexarm::assumed_modes
