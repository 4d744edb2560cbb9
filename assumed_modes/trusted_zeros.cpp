#include "assumed_modes/trusted_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace flexarm::assumed_modes {

namespace {

/// The root with Re >= 0 and Im >= 0 of each sigma^2, ascending in modulus.
std::vector<std::complex<Real>> first_quadrant_roots(const PencilZeros& zeros) {
  std::vector<std::complex<Real>> roots;
  for (const auto& square : zeros.sigma_squared) {
    const auto root = std::sqrt(square);
    roots.emplace_back(std::abs(root.real()), std::abs(root.imag()));
  }
  std::ranges::sort(roots, {}, [](const auto& root) { return std::abs(root); });
  return roots;
}

Real distance_to_nearest(std::complex<Real> root, const std::vector<std::complex<Real>>& others) {
  Real distance = std::numeric_limits<Real>::infinity();
  for (const auto& other : others) distance = std::min(distance, std::abs(root - other));
  return distance;
}

}  // namespace

arm::ZeroSet trusted_zeros(const PencilZeros& zeros, std::span<const PencilZeros> checks,
                           double zero_change, int count, double omega_scale_rad_per_s) {
  std::vector<std::vector<std::complex<Real>>> checking_roots;
  arm::ZeroSet result;
  result.summary.converged = zeros.converged;
  for (const PencilZeros& check : checks) {
    checking_roots.push_back(first_quadrant_roots(check));
    result.summary.converged = result.summary.converged && check.converged;
  }

  for (const auto& root : first_quadrant_roots(zeros)) {
    Real distance = 0;
    for (const auto& others : checking_roots) {
      distance = std::max(distance, distance_to_nearest(root, others));
    }
    const auto change = static_cast<double>(distance / std::abs(root));
    const std::complex<double> s_rad_per_s(root * static_cast<Real>(omega_scale_rad_per_s));
    if (!(change <= zero_change)) {
      result.rejected.push_back(
          {s_rad_per_s, change,
           fmt::format("relative change above {} when functions are added", zero_change)});
    } else if (static_cast<int>(result.s_rad_per_s.size()) < count) {
      result.s_rad_per_s.push_back(s_rad_per_s);
      result.summary.largest_residual = std::max(result.summary.largest_residual, change);
    }
  }
  result.infinite = zeros.infinite;
  result.count.found = static_cast<int>(result.s_rad_per_s.size());
  return result;
}

}  // namespace flexarm::assumed_modes
