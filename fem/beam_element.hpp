#pragma once

#include <Eigen/Core>

namespace flexarm::fem {

/// A beam element with continuous deflection y and rotation psi of its cross-section, of polynomial
/// degree p >= 3, on the reference interval xi in [-1, 1]; y' = psi (Euler-Bernoulli), or y' = psi
/// + gamma with a shear strain gamma (Timoshenko).
///
/// Its shape functions are the four cubic Hermite functions, in the order deflection and rotation
/// at the left end, deflection and rotation at the right end; p - 3 bubbles; and of a sheared
/// element p - 1 shear strains. The bubble of order k = 2 ... p - 2 has the Legendre polynomial P_k
/// as its curvature and vanishes with its slope at both ends (hierarchical functions
/// [SzaboBabuska1991]). The shear strain of order k = 0 ... p - 2 is P_k and
/// leaves both ends where they are: without further rotation for k >= 1, while that of order 0
/// needs psi = P_2 - P_0. The coordinate of a rotation is psi, that of a bubble the amplitude of
/// P_k in psi', that of a shear strain its amplitude.
///
/// Curvature psi' and shear strain are arbitrary polynomials of degree p - 2, independent of each
/// other: no locking. Their Legendre polynomials are orthogonal, so that the strain energy is
/// diagonal in the natural deformations of the element:
///
///     d0 = psi_b - psi_a,   d1 = h (psi_a + psi_b)/2 + h gamma_0 - (y_b - y_a),   bubbles a_k,
///     psi' = d0/h + 6 d1 P_1/h^2 + sum a_k P_k,   gamma = sum gamma_k P_k,
///     2 V = EI (d0^2/h + 12 d1^2/h^3 + sum h a_k^2/(2k + 1)) + kGA sum h gamma_k^2/(2k + 1).
class BeamElement {
 public:
  static constexpr int kLowestDegree = 3;
  /// Above this the bubbles add nothing but rounding for any beam of practical interest.
  static constexpr int kHighestDegree = 33;

  /// Throws arm::InputError for a degree outside the range above.
  explicit BeamElement(int degree, bool sheared = false);

  int degree() const { return degree_; }
  int bubbles() const { return degree_ - 3; }
  int shear_strains() const { return shape_functions() - 4 - bubbles(); }
  int shape_functions() const { return static_cast<int>(unit_deflection_.rows()); }

  /// Legendre coefficients of y, y' and psi of the shape functions of an element of length `h`,
  /// shape_functions() x (p + 1): that of shape function i is sum_k c(i, k) P_k(xi).
  Eigen::MatrixXd deflection(double h) const;
  Eigen::MatrixXd slope(double h) const;
  Eigen::MatrixXd rotation(double h) const;

  /// int y_i y_j dx and int psi_i psi_j dx, exact.
  Eigen::MatrixXd mass(double h) const;
  Eigen::MatrixXd rotary_mass(double h) const;
  /// int P y_i' y_j' dx for P = middle + half_rise xi, exact.
  Eigen::MatrixXd tension(double h, double middle, double half_rise) const;

 private:
  Eigen::VectorXd scale(double h) const;

  int degree_;
  Eigen::MatrixXd unit_deflection_;
  Eigen::MatrixXd unit_slope_;  ///< dy/dxi
  Eigen::MatrixXd unit_rotation_;
  Eigen::MatrixXd unit_mass_;
  Eigen::MatrixXd unit_rotary_mass_;
  Eigen::MatrixXd unit_tension_;       ///< under P = 1
  Eigen::MatrixXd unit_tension_rise_;  ///< under P = xi
};

/// Values P_0(xi) ... P_n(xi) of the Legendre polynomials, xi in [-1, 1].
Eigen::VectorXd legendre_values(int n, double xi);

}  // namespace flexarm::fem
