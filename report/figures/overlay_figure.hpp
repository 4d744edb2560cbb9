#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/figures/figure.hpp"

#include <cstddef>
#include <optional>

namespace flexarm::report {

/// Of a run in time the signal of the hub and the one of the tip (or the torque) with the largest
/// NRMSE of the baseline, of those that were predicted, the larger first: measurement and
/// simulation over the stretch of `kDrawnSamples` where the baseline's residuals are largest. Below
/// each signal the residuals of the baseline and, where effects were identified, of the extended
/// arm, each on a scale of its own. Empty where no signal was predicted.
std::optional<Figure> overlay_figure(const diagnose::Experiment& experiment,
                                     const diagnose::Diagnosis& diagnosis, std::size_t run);
inline constexpr std::size_t kDrawnSamples = 500;

}  // namespace flexarm::report
