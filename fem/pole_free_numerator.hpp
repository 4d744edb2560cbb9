#pragma once

#include "fem/discretisation.hpp"
#include "fem/sensor_row.hpp"

#include <Eigen/Core>

#include <complex>
#include <span>

namespace flexarm::fem {

/// Where Newton's method went.
struct NewtonResult {
  std::complex<double> w;
  bool converged = false;
  int steps = 0;
  double last_step = 0.0;  ///< relative to |w|
};

/// The numerator of hub torque to the reading c(w)^T u as a function of w = s^2, dimensionless and
/// undamped,
///
///     N(w) = F(w) prod_i (1 + w/omega_i^2),   F(w) = c(w)^T u(w) for u(0) = 1.
///
/// F has its poles where the arm vibrates with the hub clamped, at w = -omega_i^2; the lowest
/// are taken out. Each value costs one factorisation, linear in the number of elements.
class PoleFreeNumerator {
 public:
  using Complex = std::complex<double>;

  /// Takes out `poles` poles, found to `tolerance` (see vibration_modes). `discretisation` must
  /// outlive the object.
  PoleFreeNumerator(const Discretisation& discretisation, SensorRow row, int poles,
                    double tolerance);

  const SensorRow& row() const { return row_; }

  /// Newton's method from `w` to a root of N(w)/prod_j (w - found_j) (Maehly's deflation, which
  /// does not spoil the roots that remain). Ends after a step of 1e-9 |w|, whose square is the
  /// error left, or when rounding keeps steps below 1e-7 |w| from shrinking.
  NewtonResult root_near(Complex w, std::span<const Complex> found, int steps_allowed) const;

  /// Roots in |w| < `radius`, conjugates counted apart, by the turns of N around that circle
  /// (argument principle); -1 when the turns cannot be told or poles within it were not taken out.
  int roots_inside(double radius) const;

 private:
  struct Value {
    Complex direction;       ///< N/|N|
    Complex log_derivative;  ///< N'/N
    bool zero = false;
  };
  Value operator()(Complex w) const;

  const Discretisation& model_;
  SensorRow row_;
  Eigen::VectorXd poles_;
};

}  // namespace flexarm::fem
