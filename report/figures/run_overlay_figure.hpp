#pragma once

#include "compare/measured_runs.hpp"
#include "report/figures/figure.hpp"

#include <cstddef>

namespace flexarm::report {

/// Each measured signal of a run and its simulation, with its fit, the residual below; at the
/// bottom what drives the simulation: the torque, or the reference of a closed loop. The whole run,
/// and of more than `kWholeSamples` at its right those where residuals are largest.
Figure run_overlay_figure(const compare::MeasuredTimeRun& run);
inline constexpr std::size_t kWholeSamples = 500;

}  // namespace flexarm::report
