#pragma once

#include "measured/modal/variable_projection.hpp"

#include <span>

namespace flexarm::measured {

/// Weighs the readings of runs by what a fit of all of them leaves of each: maximum likelihood for
/// noise that is of one size in a sensor and run, not in all runs of a sensor. Weights of a sensor
/// are such that its weighted noise is that of all runs together. `to` are stretches of the same
/// runs as the fit's, in their order.
///
/// Returns whether the noise of a sensor differs between runs by more than `kUneven`; else nothing
/// is changed.
bool weigh_runs(const BlockFit& fit, std::span<Stretch> to);
inline constexpr double kUneven = 1.2;  ///< ratio of standard deviations

}  // namespace flexarm::measured
