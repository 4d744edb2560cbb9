#include "fem/beam_element.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::fem {

namespace {

/// Legendre coefficients of y with dy/dxi, d2y/dxi2 and, for the shear strains, dy/dxi as the
/// coordinates.
Eigen::MatrixXd deflection_in_xi(int degree, int shape_functions) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(shape_functions, degree + 1);
  c.row(0).head(4) << 0.5, -0.6, 0.0, 0.1;
  c.row(1).head(4) << 1.0 / 6.0, -0.1, -1.0 / 6.0, 0.1;
  c.row(2).head(4) << 0.5, 0.6, 0.0, -0.1;
  c.row(3).head(4) << -1.0 / 6.0, -0.1, 1.0 / 6.0, 0.1;
  // int P_k = (P_{k+1} - P_{k-1})/(2k + 1), twice; the constants vanish for k >= 2.
  for (int k = 2; k <= degree - 2; ++k) {
    const double below = 1.0 / ((2.0 * k + 1.0) * (2.0 * k - 1.0));
    const double above = 1.0 / ((2.0 * k + 1.0) * (2.0 * k + 3.0));
    c(k + 2, k - 2) = below;
    c(k + 2, k) = -below - above;
    c(k + 2, k + 2) = above;
  }
  // y' = P_k, and P_2 for k = 0.
  const int strains = degree + 1;
  for (int i = strains; i < shape_functions; ++i) {
    const int k = i == strains ? 2 : i - strains;
    c(i, k + 1) = 1.0 / (2.0 * k + 1.0);
    c(i, k - 1) = -1.0 / (2.0 * k + 1.0);
  }
  return c;
}

/// Coefficients of the derivative: P_j' = sum (2k + 1) P_k over k = j - 1, j - 3, ...
Eigen::MatrixXd derivative(const Eigen::MatrixXd& series) {
  const Eigen::Index last = series.cols() - 1;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(series.rows(), series.cols());
  // result_k/(2k + 1) = result_{k+2}/(2k + 5) + series_{k+1}.
  for (Eigen::Index k = last - 1; k >= 0; --k) {
    const double here = 2.0 * static_cast<double>(k) + 1.0;
    result.col(k) = here * series.col(k + 1);
    if (k + 2 <= last) result.col(k) += here / (here + 4.0) * result.col(k + 2);
  }
  return result;
}

/// (a W b^T) of two equal series, symmetric to the last bit.
Eigen::MatrixXd product(const Eigen::MatrixXd& series, const Eigen::MatrixXd& weight) {
  const Eigen::MatrixXd p = series * weight * series.transpose();
  return (p + p.transpose()) / 2.0;
}

}  // namespace

BeamElement::BeamElement(int degree, bool sheared) : degree_(degree) {
  if (degree < kLowestDegree || degree > kHighestDegree) {
    throw arm::out_of_range("degree", degree, "",
                            fmt::format("{} to {}", kLowestDegree, kHighestDegree));
  }
  const int strains = degree + 1;
  unit_deflection_ = deflection_in_xi(degree, strains + (sheared ? degree - 1 : 0));
  unit_slope_ = derivative(unit_deflection_);
  unit_rotation_ = unit_slope_;
  for (Eigen::Index i = strains; i < unit_rotation_.rows(); ++i) {
    unit_rotation_.row(i).setZero();
    if (i == strains) unit_rotation_.row(i).head(3) << -1.0, 0.0, 1.0;
  }
  // int P_k^2 = 2/(2k + 1);  xi P_k = ((k + 1) P_{k+1} + k P_{k-1})/(2k + 1).
  Eigen::MatrixXd norms = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  Eigen::MatrixXd rise = norms;
  for (int k = 0; k <= degree; ++k) {
    norms(k, k) = 2.0 / (2.0 * k + 1.0);
    if (k == degree) break;
    rise(k, k + 1) = (k + 1.0) / (2.0 * k + 1.0) * 2.0 / (2.0 * k + 3.0);
    rise(k + 1, k) = rise(k, k + 1);
  }
  unit_mass_ = product(unit_deflection_, norms);
  unit_rotary_mass_ = product(unit_rotation_, norms);
  unit_tension_ = product(unit_slope_, norms);
  unit_tension_rise_ = product(unit_slope_, rise);
}

Eigen::VectorXd BeamElement::scale(double h) const {
  Eigen::VectorXd s = Eigen::VectorXd::Constant(shape_functions(), h / 2.0);
  s.head(4) << 1.0, h / 2.0, 1.0, h / 2.0;
  s.segment(4, bubbles()).setConstant(h * h / 4.0);
  return s;
}

Eigen::MatrixXd BeamElement::deflection(double h) const {
  return scale(h).asDiagonal() * unit_deflection_;
}

Eigen::MatrixXd BeamElement::slope(double h) const {
  return (2.0 / h) * (scale(h).asDiagonal() * unit_slope_);
}

Eigen::MatrixXd BeamElement::rotation(double h) const {
  return (2.0 / h) * (scale(h).asDiagonal() * unit_rotation_);
}

Eigen::MatrixXd BeamElement::mass(double h) const {
  const Eigen::VectorXd s = scale(h);
  return (h / 2.0) * (s * s.transpose()).cwiseProduct(unit_mass_);
}

Eigen::MatrixXd BeamElement::rotary_mass(double h) const {
  const Eigen::VectorXd s = scale(h);
  return (2.0 / h) * (s * s.transpose()).cwiseProduct(unit_rotary_mass_);
}

Eigen::MatrixXd BeamElement::tension(double h, double middle, double half_rise) const {
  const Eigen::VectorXd s = scale(h);
  return (2.0 / h) *
         (s * s.transpose()).cwiseProduct(middle * unit_tension_ + half_rise * unit_tension_rise_);
}

Eigen::VectorXd legendre_values(int n, double xi) {
  Eigen::VectorXd values(n + 1);
  const double inside = std::clamp(xi, -1.0, 1.0);
  for (int k = 0; k <= n; ++k) values[k] = std::legendre(static_cast<unsigned>(k), inside);
  return values;
}

}  // namespace flexarm::fem
