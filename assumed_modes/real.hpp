#pragma once

#include <Eigen/Core>

#include <limits>

namespace flexarm::assumed_modes {

/// Arithmetic of this room: 64-bit significand on x86. The tenth eigenvalue of a link with a
/// payload of ten times its mass is 1e-7 of the first, which would leave double with nine digits.
using Real = long double;
static_assert(std::numeric_limits<Real>::digits >= 64);
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// The lower triangle mirrored: symmetric to the last bit.
inline Matrix mirrored(const Matrix& lower) {
  return lower.selfadjointView<Eigen::Lower>();
}

}  // namespace flexarm::assumed_modes
