#pragma once

#include "experiment/simulated_experiment.hpp"

#include <vector>

namespace flexarm::experiment {

/// Flexible modes of the runs of an experiment.
struct ModeChoice {
  response::Truncation truncation;  ///< of all runs the largest errors
  int coupled = 0;  ///< the lowest ones, stepped together; those beyond are stepped one by one
};

/// The modes that `options` ask for, or as many as the runs need. Throws InputError as
/// `simulate_experiment`, arm::Cancelled where the progress function ends it.
ModeChoice choose_modes(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                        const std::vector<arm::Sensor>& sensors, const ExperimentOptions& options,
                        const ProgressOf& progress_of);
inline constexpr int kCoupledModes = 40;       ///< at most, where others are stepped one by one
inline constexpr int kMostSingleModes = 1000;  ///< of the arm, these among them

}  // namespace flexarm::experiment
