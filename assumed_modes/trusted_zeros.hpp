#pragma once

#include "arm/formulation.hpp"
#include "assumed_modes/pencil_zeros.hpp"

#include <span>

namespace flexarm::assumed_modes {

/// Sorts the roots of a discrete zero problem into zeros of the arm and rejected ones by what more
/// functions make of them. A root s is trusted when every member of `checks` has a root s' with
/// |s - s'| <= zero_change |s|. Returns the first `count` trusted ones in units of
/// `omega_scale_rad_per_s`, and all that were rejected.
arm::ZeroSet trusted_zeros(const PencilZeros& zeros, std::span<const PencilZeros> checks,
                           double zero_change, int count, double omega_scale_rad_per_s);

}  // namespace flexarm::assumed_modes
