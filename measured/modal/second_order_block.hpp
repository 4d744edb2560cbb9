#pragma once

#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace flexarm::measured {

/// 1/(s^2 + a1 s + a0) with real a1, a0: a pair of complex poles or two real ones, smoothly.
struct SecondOrderBlock {
  double a1_rad_per_s = 0.0;
  double a0_rad2_per_s2 = 0.0;  ///< 0 for the rigid-body block, above 0 for the others

  /// sqrt(a0).
  double omega_rad_per_s() const;
  /// a1/(2 sqrt(a0)); 1 or more for real poles. a0 > 0.
  double damping_ratio() const;
  /// Conjugates, the one with Im > 0 first; or two real ones, the nearer to 0 first.
  std::array<std::complex<double>, 2> poles_rad_per_s() const;
  std::complex<double> value(std::complex<double> s_rad_per_s) const;

  bool operator==(const SecondOrderBlock&) const = default;
};

/// The block with undamped natural frequency `omega_rad_per_s` > 0.
SecondOrderBlock block_of(double omega_rad_per_s, double damping_ratio);

/// Blocks in common to all sensors. With `rigid` the first is the rigid-body block, a0 = 0.
///
/// Their parameters theta: a1 of the rigid-body block; then log(omega), damping ratio of each
/// other. The logarithm keeps a0 above 0. Damping has no such bound: an undamped pole would lie on
/// it, where an estimate is neither normal nor unbiased, so that intervals would not cover.
struct BlockSet {
  std::vector<SecondOrderBlock> blocks;
  bool rigid = true;
  /// Of the last blocks, whose poles stay where they are and have no parameters.
  std::size_t held = 0;

  Eigen::Index parameters() const;
  /// Index of the first parameter of `block`; a block has one (rigid), two, or none (held).
  Eigen::Index first_parameter(std::size_t block) const;
  bool is_rigid(std::size_t block) const { return rigid && block == 0; }
  bool is_held(std::size_t block) const { return block >= free_blocks(); }
  /// Those that are not held; they come first.
  std::size_t free_blocks() const { return blocks.size() - held; }
  Eigen::VectorXd theta() const;
  /// Blocks of the same kinds with other parameters.
  BlockSet with(const Eigen::VectorXd& theta) const;
  /// d(a1, a0)/d(parameter i of `block`): row i; 1 x 2, 2 x 2 or 0 x 2.
  Eigen::MatrixXd coefficient_derivatives(std::size_t block) const;
};

}  // namespace flexarm::measured
