#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/figures/figure.hpp"

#include <cstddef>
#include <optional>

namespace flexarm::report {

/// Whether the extended arm is another one than the arm file's: it has causes, a law, or numbers
/// that were refitted.
bool has_after(const diagnose::Diagnosis& diagnosis);

/// Of a run in time the signal of the hub and the one of the tip (or the torque) with the largest
/// NRMSE of the baseline, of those that were predicted, the larger first: measurement and
/// simulation. Below each signal the residuals of the baseline and of the extended arm, where there
/// is one, each on a scale of its own; at the bottom the torque. The whole run, and of more than
/// `kDrawnSamples` at its right those where the baseline's residuals are largest. Empty where no
/// signal was predicted.
std::optional<Figure> overlay_figure(const diagnose::Experiment& experiment,
                                     const diagnose::Diagnosis& diagnosis, std::size_t run);
inline constexpr std::size_t kDrawnSamples = 500;

}  // namespace flexarm::report
