#pragma once

#include "experiment/payload_models.hpp"
#include "experiment/run_choice.hpp"
#include "response/mode_choice.hpp"
#include "response/time/simulation.hpp"

#include <functional>
#include <vector>

namespace flexarm::experiment {

/// Returns an estimate of the truncation error of `modes` flexible modes, one a sensor: the largest
/// over the runs, relative to the signal (response/mode_choice.hpp). A time run is simulated with
/// `modes` and twice as many, from its first torque on, over at most `kEstimatedSamples`. A stepped
/// sine is compared with the transfer function of the formulation. Throws InputError as `simulate`.
std::vector<double> truncation(const std::vector<PlannedRun>& runs, PayloadModels& models,
                               int modes, response::SimulationOptions stepping);
inline constexpr std::size_t kEstimatedSamples = 8192;

/// Returns the fewest modes whose truncation error is within response::kTruncationTolerance at every
/// sensor in every run, at most response::kMostChosenModes, and half as many as the formulation is
/// fine enough for. `trying` is called before each number of modes; what it throws passes through.
response::ModeChoice needed_modes(const std::vector<PlannedRun>& runs, PayloadModels& models,
                                  const response::SimulationOptions& stepping,
                                  const std::function<void(int modes)>& trying = {});

}  // namespace flexarm::experiment
