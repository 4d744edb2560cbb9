#pragma once

#include "arm/sensor.hpp"
#include "fem/discretisation.hpp"

#include <Eigen/Core>

#include <complex>

namespace flexarm::fem {

/// What a sensor reads off the coordinates u of a motion at the complex frequency s,
/// dimensionless and before time derivatives:
///
///     c^T u                                        for hub angle and tip displacement,
///     -(s^2 M k + s ca A k + G k)^T u              for tip deflection and strain.
///
/// The second form is the principle of virtual work: the inertia and other forces of the motion
/// work on the influence shape k of the quantity read. For the curvature psi' at X the shape is the
/// ramp max(x - X, 0) over 1 + kv s, so that the reading is the moment about X of all that lies
/// beyond X; this is as accurate as deflections are (order h^(2p-2)), where the curvature of the
/// shape functions is of order h^(p-1) only, and the same on both sides of a crack. For the tip
/// deflection the shape is that of the clamped arm under a unit tip force, its bending over 1 + kv
/// s and its root's rotation over 1 + tr s; the form then equals y(l) - (a + l) theta exactly.
/// Without gravity it takes out the root at s = 0 that the rigid rotation, which these sensors do
/// not see, puts into the numerator.
class SensorRow {
 public:
  using Complex = std::complex<double>;

  /// `sensor` is valid for the arm.
  SensorRow(const Discretisation& discretisation, const arm::Sensor& sensor);

  /// The reading of an undamped motion at s^2 = w.
  double undamped_reading(const Eigen::VectorXd& u, double w) const;
  Complex reading(const Eigen::VectorXcd& u, Complex s) const;

  /// The row whose product with u has the zeros of the undamped reading, constant + w times_w; the
  /// second part is empty where it is zero. A factor w is left out.
  const Eigen::VectorXd& constant() const { return constant_; }
  const Eigen::VectorXd& times_w() const { return times_w_; }
  /// Roots at infinity of the Rosenbrock pencil, of order n + 1, with this row: 2 for a general
  /// constant one, one more where c^T M^-1 e0 = 0, the influence shape having no hub rotation, and
  /// one more where the torque reaches what the row reads through the drive's spring; one less for
  /// a row that has the factor w.
  int infinite_roots() const { return infinite_roots_; }

 private:
  bool by_equilibrium_ = false;
  int infinite_roots_ = 2;
  double kelvin_voigt_;
  double root_retardation_;
  double air_damping_;
  Eigen::VectorXd constant_;
  Eigen::VectorXd times_w_;
  Discretisation::VirtualWork bending_;
  Discretisation::VirtualWork root_;  ///< here and below empty for strain
  Discretisation::VirtualWork rest_;
};

/// Factor from the dimensionless reading (rotation 1, displacement l, curvature 1/l) to SI.
double si_reading(const arm::LinearArm& arm, const arm::Sensor& sensor);

}  // namespace flexarm::fem
