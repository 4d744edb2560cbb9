#pragma once

#include "response/experiment/simulated_experiment.hpp"

#include <string>

namespace flexarm::report {

/// The document of `simulate --json` (docs/json.md).
std::string simulation_document(const arm::Arm& arm,
                                const response::SimulatedExperiment& experiment,
                                const response::ExperimentOptions& options);

}  // namespace flexarm::report
