#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"
#include "report/figures/figure.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::report {

/// Of each run `autopower-RUN`, `frf-RUN-SENSOR` with the fit and the analytical response,
/// `circles-RUN-SENSOR` and `distortion-RUN-SENSOR` where there are any; of each fit
/// `stabilisation-RUNS`.
std::vector<NamedFigure> identification_plots(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions);

/// The transfer function of a sensor by the fit that the run, an index, is part of; empty where
/// there is none.
std::optional<measured::FittedTransfer> fitted_transfer(
    const measured::Identification& identification, std::size_t run, const arm::Sensor& sensor);

}  // namespace flexarm::report
