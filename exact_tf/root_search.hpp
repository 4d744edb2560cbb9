#pragma once

#include "exact_tf/bracketed_roots.hpp"
#include "exact_tf/numerator.hpp"

namespace flexarm::exact_tf {

/// The most roots that are looked for: lambda up to 3.2e7, where its phase keeps eleven digits;
/// some 5 us and 40 bytes each.
inline constexpr int kMostRoots = 10'000'000;

/// The `count` lowest flexible poles. 1 <= count <= kMostRoots, else
/// std::invalid_argument.
RealRoots find_poles(const InertiaRatios& ratios, int count, const RootSearchOptions& options = {});

/// The `count` lowest hub-angle zeros. 1 <= count <= kMostRoots, else
/// std::invalid_argument.
RealRoots find_hub_zeros(const InertiaRatios& ratios, int count,
                         const RootSearchOptions& options = {});

}  // namespace flexarm::exact_tf
