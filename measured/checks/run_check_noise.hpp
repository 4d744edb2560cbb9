#pragma once

#include "measured/checks/run_check.hpp"

#include <vector>

namespace flexarm::measured {

/// Channels whose noise in a run is a multiple of what half of the other runs with the same sensor
/// lead to expect, where at most half of the runs have so much.
///
/// A run's noise counts where what the samples around and the other channels do not predict is
/// white and normal (unpredicted_noise), or where the upper half of the channel's spectrum is white
/// and as strong as that. In the other runs the lowest band of the spectrum and the prediction's
/// residual are upper bounds.
///
/// Noise in proportion to the channel's standard deviation is that of the instrument's range, and
/// no finding.
///
/// Runs with a finding in their times are left out, and channels with one.
std::vector<RunFinding> check_noise_between_runs(const std::vector<CheckedRun>& runs);

}  // namespace flexarm::measured
