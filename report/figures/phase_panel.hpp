#pragma once

#include "report/figures/figure.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::report {

/// A phase curve, with a gap wherever it wraps: no line is drawn across the panel.
Series phase_series(std::string name, const std::vector<double>& frequency_Hz,
                    const std::vector<double>& phase_deg, const Style& style);

/// The axis of phases [deg], in quarter turns, or more of them where the curves run over several
/// turns. Without a value the axis is one without limits.
Axis phase_axis(std::span<const Series> curves);

}  // namespace flexarm::report
