#pragma once

#include <Eigen/Core>

namespace flexarm::trials {

/// Shape functions of one element at one place: y = deflection^T u, psi = rotation^T u, and their
/// derivatives along the beam. With shear psi is not y'.
struct ElementShapes {
  Eigen::VectorXd deflection;
  Eigen::VectorXd slope;  ///< y'
  Eigen::VectorXd rotation;
  Eigen::VectorXd curvature;  ///< psi'
};

/// Hermite's cubic, u = (y, y', y, y') of the ends: the deflection that bends a beam without loads
/// along it, so that psi = y' and the curvature is linear.
///
/// With shear: y cubic by its values at 0, 1/3, 2/3, 1 and psi quadratic by its values at 0, 1/2,
/// 1, u = (y, psi, y, y, psi, y, psi) along the element. y' and psi are then of one degree, so that
/// y' = psi is possible all along and nothing locks; curvature and shear strain are as exact as
/// the cubic's curvature at least.
ElementShapes element_shapes(bool with_shear, double length_m, double part);

/// Entries of u.
int element_size(bool with_shear);

}  // namespace flexarm::trials
