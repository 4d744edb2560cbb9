#pragma once

#include "arm/arm.hpp"

#include <span>
#include <string_view>

namespace flexarm::arm {

/// What a key of the arm file ends in that says how uncertain another is: youngs_modulus,
/// youngs_modulus_uncertainty.
inline constexpr std::string_view kUncertaintySuffix = "_uncertainty";

/// Throws InputError for the first uncertainty that is not above 0 and below 1, or that is of a
/// number which the arm does not give, which is 0, or which another makes useless.
void require_valid_uncertainties(const Arm& arm);

/// The arm whose uncertain numbers, in the order of `Arm::relative_uncertainties`, are off by so
/// many standard deviations: each is exp(uncertainty deviations) times what it was, which leaves it
/// its sign. `deviations` has as many entries as these, or none.
Arm with_deviations(const Arm& arm, std::span<const double> deviations);

}  // namespace flexarm::arm
