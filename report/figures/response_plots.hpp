#pragma once

#include "report/figures/comparison_plots.hpp"
#include "response/frequency/response_study.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// SVG documents by file name: `bode-SENSOR.svg` of each sensor, with the state space and its error
/// where there is one, and `nyquist-SENSOR.svg` where a damped pole lies in the range.
/// `formulation` is the name of the reference curve. Throws as `to_svg` does.
std::vector<NamedPlot> response_plots(const std::string& formulation,
                                      const response::ResponseStudy& study);

}  // namespace flexarm::report
