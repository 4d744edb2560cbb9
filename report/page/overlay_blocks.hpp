#pragma once

#include "report/page/diagnosed_channels.hpp"

namespace flexarm::report::page {

/// Measured and simulated signals of `time` runs over time, below them the residuals and what drove
/// the run, each on a scale of its own; a view a run and sensor. The whole runs are in it; of runs
/// of more than `kWorstSamples` so many are in view first, where the simulation of the arm file is
/// furthest off. No views without such runs.
CurvesBlock overlay_block(const std::vector<DiagnosedChannel>& channels, bool has_causes);
inline constexpr std::size_t kWorstSamples = 500;

/// Auto-correlation of the residuals and their cross-correlation with the input, with bounds of
/// 99 %, as `resid` of MATLAB has them; a view a run and sensor.
CurvesBlock correlation_block(const std::vector<DiagnosedChannel>& channels, bool has_causes,
                              bool is_driven_by_motion);
inline constexpr std::size_t kMostLag = 100;

}  // namespace flexarm::report::page
