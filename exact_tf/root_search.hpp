#pragma once

#include "arm/formulation.hpp"
#include "exact_tf/numerator.hpp"

#include <vector>

namespace flexarm::exact_tf {

/// The most roots that are looked for: lambda up to 3.2e7, where its phase keeps eleven digits;
/// some 5 us and 40 bytes each.
inline constexpr int kMostRoots = 10'000'000;

struct RootSearchOptions {
  /// A bracket is narrowed until its width <= 2^(1 - significand_bits) lambda.
  unsigned significand_bits = 61;
  /// Function values allowed to a root after its isolation.
  int maximum_function_values = 200;
};

/// Roots on the positive real lambda axis, ascending, with the proof that they are all: `count`
/// compares them with the count just above the last.
struct RealRoots {
  std::vector<Real> lambda;
  arm::RootCount count;
  arm::SolveSummary summary;  ///< largest_residual: widest final bracket over its lambda
};

/// The `count` lowest flexible poles. 1 <= count <= kMostRoots, else
/// std::invalid_argument.
RealRoots find_poles(const InertiaRatios& ratios, int count, const RootSearchOptions& options = {});

/// The `count` lowest hub-angle zeros. 1 <= count <= kMostRoots, else
/// std::invalid_argument.
RealRoots find_hub_zeros(const InertiaRatios& ratios, int count,
                         const RootSearchOptions& options = {});

}  // namespace flexarm::exact_tf
