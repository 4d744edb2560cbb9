#include "measured/modal/held_response.hpp"

#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>

namespace flexarm::measured {

HeldResponse::HeldResponse(const SecondOrderBlock& block, double period_s, TorqueHold hold) {
  // In time n t and states (n^2 q, n q', n^4 p, n^3 p') all entries are of one size, so that the
  // exponential is right to rounding in each.
  const double n = std::max(block.omega_rad_per_s(), 1.0 / period_s);
  Eigen::Matrix<double, 6, 6> generator = Eigen::Matrix<double, 6, 6>::Zero();
  for (const int first : {0, 2}) {
    generator(first, first + 1) = 1.0;
    generator(first + 1, first) = -block.a0_rad2_per_s2 / (n * n);
    generator(first + 1, first + 1) = -block.a1_rad_per_s / n;
  }
  generator(3, 0) = 1.0;                   // p'' + a1 p' + a0 p = q
  generator(1, 4) = 1.0;                   // q'' + a1 q' + a0 q = u
  generator(4, 5) = 1.0 / (n * period_s);  // u grows by the second input in a period
  const Eigen::Matrix<double, 6, 6> exponential = (generator * (n * period_s)).exp();
  const Eigen::Vector4d size(1.0 / (n * n), 1.0 / n, 1.0 / (n * n * n * n), 1.0 / (n * n * n));
  transition_ =
      size.asDiagonal() * exponential.topLeftCorner<4, 4>() * size.cwiseInverse().asDiagonal();
  now_ = size.cwiseProduct(exponential.block<4, 1>(0, 4));
  next_.setZero();
  if (hold == TorqueHold::first) {
    next_ = size.cwiseProduct(exponential.block<4, 1>(0, 5));
    now_ -= next_;
  }
}

}  // namespace flexarm::measured
