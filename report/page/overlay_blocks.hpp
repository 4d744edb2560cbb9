#pragma once

#include "report/page/diagnosed_channels.hpp"

#include <optional>

namespace flexarm::report::page {

/// Measured and simulated signals of `time` runs over time, the residuals below, each on a scale of
/// its own; a view a run and sensor. No views without such runs.
CurvesBlock overlay_block(const std::vector<DiagnosedChannel>& channels, bool has_causes);

/// The first of the channels, at the place where the simulation without causes is furthest off.
/// Empty without channels.
std::optional<CurvesBlock> worst_overlay(const std::vector<DiagnosedChannel>& channels,
                                         bool has_causes);
inline constexpr std::size_t kWorstSamples = 500;

/// Auto-correlation of the residuals and their cross-correlation with the input, with bounds of
/// 99 %, as `resid` of MATLAB has them; a view a run and sensor.
CurvesBlock correlation_block(const std::vector<DiagnosedChannel>& channels, bool has_causes,
                              bool is_driven_by_motion);
inline constexpr std::size_t kMostLag = 100;

}  // namespace flexarm::report::page
