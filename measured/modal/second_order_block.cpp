#include "measured/modal/second_order_block.hpp"

#include <cmath>

namespace flexarm::measured {

using Complex = std::complex<double>;

double SecondOrderBlock::omega_rad_per_s() const {
  return std::sqrt(a0_rad2_per_s2);
}

double SecondOrderBlock::damping_ratio() const {
  return a1_rad_per_s / (2.0 * omega_rad_per_s());
}

std::array<Complex, 2> SecondOrderBlock::poles_rad_per_s() const {
  const double half = 0.5 * a1_rad_per_s;
  const double discriminant = half * half - a0_rad2_per_s2;
  if (discriminant < 0.0) {
    const double damped = std::sqrt(-discriminant);
    return {Complex(-half, damped), Complex(-half, -damped)};
  }
  // The root of larger size has no cancellation; the other follows from their product.
  const double far = -(half + std::copysign(std::sqrt(discriminant), half));
  return {far == 0.0 ? 0.0 : a0_rad2_per_s2 / far, far};
}

Complex SecondOrderBlock::value(Complex s) const {
  return 1.0 / (s * (s + a1_rad_per_s) + a0_rad2_per_s2);
}

SecondOrderBlock block_of(double omega_rad_per_s, double damping_ratio) {
  return {2.0 * damping_ratio * omega_rad_per_s, omega_rad_per_s * omega_rad_per_s};
}

Eigen::Index BlockSet::parameters() const {
  return 2 * static_cast<Eigen::Index>(free_blocks()) - (rigid ? 1 : 0);
}

Eigen::Index BlockSet::first_parameter(std::size_t block) const {
  if (is_held(block)) return parameters();
  const auto twice = 2 * static_cast<Eigen::Index>(block);
  return rigid && block > 0 ? twice - 1 : twice;
}

Eigen::VectorXd BlockSet::theta() const {
  Eigen::VectorXd theta(parameters());
  for (std::size_t m = 0; m < free_blocks(); ++m) {
    const Eigen::Index i = first_parameter(m);
    if (is_rigid(m)) {
      theta(i) = blocks[m].a1_rad_per_s;
    } else {
      theta(i) = 0.5 * std::log(blocks[m].a0_rad2_per_s2);
      theta(i + 1) = blocks[m].damping_ratio();
    }
  }
  return theta;
}

BlockSet BlockSet::with(const Eigen::VectorXd& theta) const {
  BlockSet other = *this;
  for (std::size_t m = 0; m < free_blocks(); ++m) {
    const Eigen::Index i = first_parameter(m);
    other.blocks[m] =
        is_rigid(m) ? SecondOrderBlock{theta(i), 0.0} : block_of(std::exp(theta(i)), theta(i + 1));
  }
  return other;
}

Eigen::MatrixXd BlockSet::coefficient_derivatives(std::size_t block) const {
  if (is_held(block)) return Eigen::MatrixXd(0, 2);
  if (is_rigid(block)) return Eigen::RowVector2d(1.0, 0.0);
  const auto& [a1, a0] = blocks[block];
  Eigen::Matrix2d rows;
  rows << a1, 2.0 * a0,  //
      2.0 * std::sqrt(a0), 0.0;
  return rows;
}

}  // namespace flexarm::measured
