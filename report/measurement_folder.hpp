#pragma once

#include "experiment/simulated_experiment.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/figure_files.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// The files of a simulated experiment's measurement folder: measurement.toml, arm.toml with
/// `written_arm`, a CSV file and a figure for each run, of a stepped sine a figure a
/// sensor, drawn with `figures`.
std::vector<measured::NamedContent> measurement_folder(
    const std::string& name, const arm::Arm& written_arm,
    const std::vector<experiment::PlannedRun>& plan,
    const experiment::SimulatedExperiment& experiment, response::TorqueHold hold,
    const FigureOptions& figures);

/// The name of the measurement where it is given none.
std::string simulated_name(const arm::Arm& arm);

}  // namespace flexarm::report
