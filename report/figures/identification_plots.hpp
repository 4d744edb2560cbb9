#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"
#include "report/figures/figure.hpp"

#include <vector>

namespace flexarm::report {

/// Of each run `autopower-RUN`, `frf-RUN-SENSOR` with the fit and the analytical response,
/// `circles-RUN-SENSOR` and `distortion-RUN-SENSOR` where there are any; of each fit
/// `stabilisation-RUNS`.
std::vector<NamedFigure> identification_plots(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions);

}  // namespace flexarm::report
