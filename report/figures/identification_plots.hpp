#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"
#include "report/figures/comparison_plots.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::report {

/// SVG documents by file name: of each run `autopower-RUN.svg`, `frf-RUN-SENSOR.svg` with the fit
/// and the analytical response, `circles-RUN-SENSOR.svg` and `distortion-RUN-SENSOR.svg` where
/// there are any; of each fit `stabilisation-RUNS.svg`. Throws as `to_svg` does.
std::vector<NamedPlot> identification_plots(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions);

/// The transfer function of a sensor by the fit that the run, an index, is part of; empty where
/// there is none.
std::optional<measured::FittedTransfer> fitted_transfer(
    const measured::Identification& identification, std::size_t run, const arm::Sensor& sensor);

}  // namespace flexarm::report
