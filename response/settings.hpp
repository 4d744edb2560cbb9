#pragma once

#include "assumed_modes/assumed_modes_arm.hpp"
#include "fem/fem_arm.hpp"

#include <string>
#include <string_view>

namespace flexarm::response {

/// The most roots that the settings below are fine enough for.
inline constexpr int kMostRoots = (assumed_modes::kMaximumFunctions - 20) / 2;

/// Settings at which the lowest `roots` poles and zeros of an arm are within 1e-10 or so of exact:
/// an element of degree 15 for every two roots, three at least.
fem::FemArm::Options fem_settings(int roots);

/// The same for assumed modes: 2 roots + 20 Legendre polynomials, at least 40 (the lowest zeros of
/// strain near the tip lie far above the lowest poles) and at most
/// assumed_modes::kMaximumFunctions.
assumed_modes::AssumedModesOptions assumed_modes_settings(int roots);

/// "fem, 4 elements of degree 11": the name alone where there are no settings.
std::string formulation_label(std::string_view formulation, std::string_view settings);

/// "4 elements of degree 11".
std::string describe(const fem::FemArm::Options& options);
/// "36 functions, basis legendre".
std::string describe(const assumed_modes::AssumedModesOptions& options);

}  // namespace flexarm::response
