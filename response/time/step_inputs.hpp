#pragma once

#include <Eigen/Core>

namespace flexarm::response {

/// What an inner step of the actuator torque and the added forces is made of: in r = t/dt the
/// torque goes straight from u0 to u1, the force is the parabola through f0, fm, f1 at r = 0,
/// 1/2, 1.
struct StepInputs {
  double u0 = 0.0;
  double u1 = 0.0;
  double begin_s = 0.0;
  double length_s = 0.0;
  Eigen::VectorXd f0;
  Eigen::VectorXd fm;
  Eigen::VectorXd f1;

  double torque(double r) const { return u0 + r * (u1 - u0); }
  double time(double r) const { return begin_s + r * length_s; }
  // Coefficients of r and r^2 of the parabola, m entries: expressions that refer to this object.
  auto force_slope() const { return -3.0 * f0 + 4.0 * fm - f1; }
  auto force_square() const { return 2.0 * (f0 - 2.0 * fm + f1); }
};

}  // namespace flexarm::response
