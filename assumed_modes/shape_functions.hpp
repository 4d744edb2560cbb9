#pragma once

#include "assumed_modes/basis.hpp"
#include "assumed_modes/beam_shapes.hpp"
#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"

namespace flexarm::assumed_modes {

/// The rigid rotation a + xi and the first shapes of a classical beam, y_i = psi_i + a psi_i'(0),
/// in units of l. The strain energy matrix is diag(0, 1, ..., 1). No shape turns in
/// a soft drive, bends at a crack or at a soft root, nor shears.
class ShapeFunctions {
 public:
  /// `basis` is any but legendre; `shapes` >= 1.
  ShapeFunctions(Basis basis, const ScaledArm& arm, int shapes);

  Eigen::Index size() const { return bends_.size(); }
  /// 0 for the rotation, 1 for the shapes.
  const Vector& bends() const { return bends_; }
  /// (1, psi_i'(0)), the drive being rigid.
  Vector hub_rotation() const { return rotation(0); }
  Vector motor_rotation() const { return hub_rotation(); }
  Vector displacement(Real xi) const;
  Vector rotation(Real xi) const;
  Vector curvature(Real xi) const;

  /// int y_i y_j, in closed form.
  Matrix displacement_products() const;
  /// int p y_i' y_j' with p = arm.tension of an arm without masses between root and tip, by Gauss's
  /// rule of 20 points on panels as long as half a wave of the highest shape: exact to rounding.
  Matrix slope_products(const ScaledArm& arm) const;

 private:
  Vector with_rotation(Real rigid, const Vector& shapes) const;

  BeamShapes shapes_;
  Real hub_radius_;
  Vector offset_;  ///< y_i(0) = a psi_i'(0): a shape that turns the hub moves the root along
  Vector bends_;
};

}  // namespace flexarm::assumed_modes
