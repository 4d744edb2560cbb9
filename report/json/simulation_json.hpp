#pragma once

#include "experiment/simulated_experiment.hpp"

#include <string>

namespace flexarm::report {

/// The document of `simulate --json` (docs/json.md).
std::string simulation_document(const arm::Arm& arm,
                                const experiment::SimulatedExperiment& experiment,
                                const experiment::ExperimentOptions& options);

}  // namespace flexarm::report
