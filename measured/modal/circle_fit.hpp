#pragma once

#include <complex>
#include <span>

namespace flexarm::measured {

/// A circle through points of the plane.
struct Circle {
  std::complex<double> centre;
  double radius = 0.0;
  double rms_distance = 0.0;  ///< of the points from the circle
  int iterations = 0;         ///< of the geometric fit
  bool converged = false;     ///< the last step was below 1e-13 radius
};

/// The circle of least squares of distances: begun with the algebraic fit of [Taubin1991], then by
/// Gauss-Newton with Levenberg's damping on sum (|z_i - centre| - radius)^2. Throws
/// std::invalid_argument for fewer than three points or points on a line.
Circle fit_circle(std::span<const std::complex<double>> points);

}  // namespace flexarm::measured
