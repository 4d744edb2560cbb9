#include "assumed_modes/trusted_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

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

std::vector<CheckedRoot> checked_roots(const PencilZeros& zeros,
                                       std::span<const PencilZeros> checks) {
  std::vector<std::vector<std::complex<Real>>> checking_roots;
  for (const PencilZeros& check : checks) checking_roots.push_back(first_quadrant_roots(check));
  std::vector<CheckedRoot> checked;
  for (const auto& root : first_quadrant_roots(zeros)) {
    Real distance = 0;
    for (const auto& others : checking_roots) {
      distance = std::max(distance, distance_to_nearest(root, others));
    }
    checked.push_back({root, static_cast<double>(distance / std::abs(root))});
  }
  return checked;
}

void TrustedZeros::add(const std::vector<CheckedRoot>& roots) {
  std::vector<Root> all = std::move(trusted_);
  for (const CheckedRoot& root : roots) {
    if (root.change <= zero_change_) {
      all.push_back({root, problems_});
    } else if (problems_ == 0) {
      rejected_.push_back(root);
    }
  }
  ++problems_;
  std::ranges::stable_sort(all, {}, [](const Root& each) { return each.root.change; });
  trusted_.clear();
  for (const Root& candidate : all) {
    // The change is a sample of the error, which may be some times as large.
    constexpr double kRounding = 1e-10;
    constexpr double kLargestError = 30.0;
    const Real same =
        std::max(kRounding, kLargestError * candidate.root.change) * std::abs(candidate.root.s);
    const bool is_there = std::ranges::any_of(trusted_, [&](const Root& other) {
      return other.problem != candidate.problem &&
             std::abs(other.root.s - candidate.root.s) <= same;
    });
    if (!is_there) trusted_.push_back(candidate);
  }
  std::ranges::sort(trusted_, {}, [](const Root& each) { return std::abs(each.root.s); });
}

bool TrustedZeros::is_explained(const CheckedRoot& rejected) const {
  constexpr double kBeside = 0.1;
  const Real beside = std::min(rejected.change, kBeside) * std::abs(rejected.s);
  return std::ranges::any_of(
      trusted_, [&](const Root& zero) { return std::abs(zero.root.s - rejected.s) <= beside; });
}

bool TrustedZeros::are_settled(int count) const {
  if (std::ssize(trusted_) < count) return false;
  const auto last = trusted_.begin() + count;
  const Real farthest = std::abs(std::prev(last)->root.s);
  return std::all_of(trusted_.begin(), last,
                     [](const Root& zero) { return zero.root.change <= kSettled; }) &&
         std::ranges::none_of(rejected_, [&](const CheckedRoot& root) {
           return std::abs(root.s) < farthest && !is_explained(root);
         });
}

arm::ZeroSet TrustedZeros::zero_set(int count, double omega_scale_rad_per_s) const {
  const auto in_rad_per_s = [&](const CheckedRoot& root) {
    return std::complex<double>(root.s * static_cast<Real>(omega_scale_rad_per_s));
  };
  arm::ZeroSet result;
  for (const Root& zero : trusted_) {
    if (std::ssize(result.s_rad_per_s) >= count) break;
    result.s_rad_per_s.push_back(in_rad_per_s(zero.root));
    result.relative_change.push_back(zero.root.change);
    result.summary.largest_residual = std::max(result.summary.largest_residual, zero.root.change);
  }
  for (const CheckedRoot& root : rejected_) {
    if (is_explained(root)) continue;
    result.rejected.push_back(
        {in_rad_per_s(root), root.change,
         fmt::format("relative change above {} when functions are added", zero_change_)});
  }
  result.count.found = static_cast<int>(result.s_rad_per_s.size());
  return result;
}

}  // namespace flexarm::assumed_modes
