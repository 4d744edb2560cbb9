#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/nyquist_figure.hpp"
#include "response/frequency/response_study.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// `bode-SENSOR` of each sensor, with the state space and its error where there is one, and
/// `nyquist-SENSOR` where a damped pole lies in the range. `formulation` is the name of the
/// reference curve.
std::vector<NamedFigure> response_plots(const std::string& formulation,
                                        const response::ResponseStudy& study,
                                        const NyquistMarks& marks = {});

}  // namespace flexarm::report
