#include "fem/hermite_element.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::fem {

namespace {

/// Legendre coefficients with dy/dxi and d2y/dxi2 as the coordinates.
Eigen::MatrixXd coefficients_in_xi(int degree) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
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
  return c;
}

}  // namespace

HermiteElement::HermiteElement(int degree) : degree_(degree) {
  if (degree < kLowestDegree || degree > kHighestDegree) {
    throw arm::out_of_range("degree", degree, "",
                            fmt::format("{} to {}", kLowestDegree, kHighestDegree));
  }
  unit_coefficients_ = coefficients_in_xi(degree);
  // int P_k^2 = 2/(2k + 1).
  const Eigen::VectorXd norms =
      Eigen::VectorXd::LinSpaced(degree + 1, 0.0, degree).unaryExpr([](double k) {
        return 2.0 / (2.0 * k + 1.0);
      });
  const Eigen::MatrixXd product =
      unit_coefficients_ * norms.asDiagonal() * unit_coefficients_.transpose();
  unit_mass_ = (product + product.transpose()) / 2.0;  // symmetric to the last bit
}

Eigen::VectorXd HermiteElement::scale(double h) const {
  Eigen::VectorXd s = Eigen::VectorXd::Constant(degree_ + 1, h * h / 4.0);
  s.head(4) << 1.0, h / 2.0, 1.0, h / 2.0;
  return s;
}

Eigen::MatrixXd HermiteElement::legendre_coefficients(double h) const {
  return scale(h).asDiagonal() * unit_coefficients_;
}

Eigen::MatrixXd HermiteElement::mass(double h) const {
  const Eigen::VectorXd s = scale(h);
  return (h / 2.0) * (s * s.transpose()).cwiseProduct(unit_mass_);
}

Eigen::MatrixXd HermiteElement::stiffness(double h) const {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(degree_ + 1, degree_ + 1);
  const Eigen::Vector4d d0(0.0, -1.0, 0.0, 1.0);
  const Eigen::Vector4d d1(1.0, h / 2.0, -1.0, h / 2.0);
  k.topLeftCorner<4, 4>() = d0 * d0.transpose() / h + 12.0 / (h * h * h) * (d1 * d1.transpose());
  for (int order = 2; order <= degree_ - 2; ++order) {
    k(order + 2, order + 2) = h / (2.0 * order + 1.0);
  }
  return k;
}

Eigen::VectorXd legendre_values(int n, double xi) {
  Eigen::VectorXd values(n + 1);
  const double inside = std::clamp(xi, -1.0, 1.0);
  for (int k = 0; k <= n; ++k) values[k] = std::legendre(static_cast<unsigned>(k), inside);
  return values;
}

}  // namespace flexarm::fem
