#pragma once

#include "arm/sensor.hpp"
#include "fem/discretisation.hpp"

#include <Eigen/Core>

namespace flexarm::fem {

/// What a sensor reads off the coordinates u of a motion at the complex frequency s,
/// dimensionless and before time derivatives:
///
///     c^T u                          for hub angle and tip displacement,
///     -s^2/(1 + kv s) c^T u          where `by_inertia`, for tip deflection and strain,
///
/// The second form is the principle of virtual work: the inertia forces -s^2 M u of the motion
/// work on the influence shape k of the quantity read, c = M k. For the curvature at X the shape
/// is max(x - X, 0), so that c^T u is the moment about X of all that lies beyond X; this
/// is as accurate as deflections are (order h^(2p-2)), where the second derivative of the shape
/// functions is of order h^(p-1) only. For the tip deflection the shape is that of the clamped arm
/// under a unit tip force, and the form equals y(l) - l theta exactly. Both take out the
/// root at s = 0 that the rigid rotation, which they do not see, puts into the numerator.
struct SensorRow {
  Eigen::VectorXd c;  ///< n
  bool by_inertia = false;
  /// Roots at infinity of the Rosenbrock pencil, of order n + 1, with this row: 2, and one more
  /// where c^T M^-1 e0 = 0, the influence shape having no hub rotation.
  int infinite_roots = 2;
};

/// `sensor` is valid for the arm.
SensorRow sensor_row(const Discretisation& discretisation, const arm::LinearArm& arm,
                     const arm::Sensor& sensor);

/// Factor from the dimensionless reading (rotation 1, displacement l, curvature 1/l) to SI.
double si_reading(const arm::LinearArm& arm, const arm::Sensor& sensor);

}  // namespace flexarm::fem
