#pragma once

#include <Eigen/Core>

namespace flexarm::fem {

/// An Euler-Bernoulli beam element with a continuous slope, of polynomial degree p >= 3, on the
/// reference interval xi in [-1, 1].
///
/// Its p + 1 shape functions are the four cubic Hermite functions, in the order deflection and
/// slope at the left end, deflection and slope at the right end, and p - 3 bubbles. The bubble of
/// order k = 2 ... p - 2 has the Legendre polynomial P_k as its curvature and vanishes with its
/// slope at both ends (hierarchical functions, Szabo and Babuska, Finite Element Analysis, 1991).
/// The coordinate of a slope is dy/dx, that of a bubble the amplitude of P_k in y''.
///
/// Curvatures are orthogonal in L2, so that the strain energy is diagonal in the natural
/// deformations of the element:
///
///     d0 = theta_b - theta_a,   d1 = h (theta_a + theta_b)/2 - (y_b - y_a),   and each bubble,
///     y'' = d0/h + 6 d1 P_1/h^2 + sum a_k P_k,
///     2 V/EI = d0^2/h + 12 d1^2/h^3 + sum h a_k^2/(2k + 1).
class HermiteElement {
 public:
  static constexpr int kLowestDegree = 3;
  /// Above this the bubbles add nothing but rounding for any beam of practical interest.
  static constexpr int kHighestDegree = 33;

  /// Throws arm::InputError for a degree outside the range above.
  explicit HermiteElement(int degree);

  int degree() const { return degree_; }
  int bubbles() const { return degree_ - 3; }

  /// Legendre coefficients of the shape functions of an element of length `h`, (p + 1) x (p + 1):
  /// shape function i is sum_k c(i, k) P_k(xi).
  Eigen::MatrixXd legendre_coefficients(double h) const;

  /// Consistent mass of an element of length `h` and unit linear density, (p + 1) x (p + 1), exact.
  Eigen::MatrixXd mass(double h) const;

  /// Stiffness of an element of length `h` and unit rigidity, (p + 1) x (p + 1), exact; for use
  /// outside the solvers, which keep it factored in natural deformations.
  Eigen::MatrixXd stiffness(double h) const;

 private:
  Eigen::VectorXd scale(double h) const;

  int degree_;
  Eigen::MatrixXd unit_coefficients_;
  Eigen::MatrixXd unit_mass_;
};

/// Values P_0(xi) ... P_n(xi) of the Legendre polynomials, xi in [-1, 1].
Eigen::VectorXd legendre_values(int n, double xi);

}  // namespace flexarm::fem
