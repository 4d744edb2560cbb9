#pragma once

#include "exact_tf/numerator.hpp"

namespace flexarm::exact_tf {

/// Number of flexible poles (roots of E, the rigid-body mode left out) in (0, lambda), by the
/// algorithm of [WittrickWilliams1971]: the count of the beam
/// clamped at both ends plus the negative pivots of the dynamic stiffness of the free end
/// displacements, hub rotation included. 0 <= lambda < 1e9.
int count_poles_below(const InertiaRatios& ratios, Real lambda);

/// Number of roots of N_hub, the poles with the hub held, in (0, lambda). 0 <= lambda < 1e9.
int count_hub_zeros_below(const InertiaRatios& ratios, Real lambda);

}  // namespace flexarm::exact_tf
