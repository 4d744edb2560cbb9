#pragma once

#include "app/formulation_choice.hpp"
#include "app/run_choice.hpp"
#include "app/sensor_choice.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/figure_files.hpp"
#include "report/tables/simulation_report.hpp"
#include "report/tables/stepped_sine_report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace flexarm::app {

/// How an experiment is simulated.
struct ExperimentOptions {
  FormulationChoice formulation;
  int modes = 5;
  bool static_correction = false;
  response::TorqueHold hold = response::TorqueHold::zero;
  int substeps = 0;
  bool check_step = false;
  std::uint64_t noise_seed = 1;
};

/// The runs of an experiment on one arm, and the model that they were simulated with.
struct SimulatedExperiment {
  std::string model;           ///< "exact_tf"
  std::string settings;        ///< empty for exact_tf
  int modes = 0;               ///< flexible ones kept
  int degrees_of_freedom = 0;  ///< of the model; 0 for exact_tf
  std::vector<report::SimulatedRun> runs;
  std::vector<report::SteppedSineRun> stepped_runs;  ///< those of the plan that are stepped sines
};

/// Simulates every run, with a line of progress on standard error.
SimulatedExperiment simulate_experiment(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                                        const std::vector<ChosenSensor>& sensors,
                                        const ExperimentOptions& options);

/// The files of the experiment's measurement folder: measurement.toml, arm.toml with `written_arm`,
/// a CSV file and a figure for each run, of a stepped sine a figure a sensor, with `figures`.
std::vector<measured::NamedContent> measurement_folder(const std::string& name,
                                                       const arm::Arm& written_arm,
                                                       const std::vector<PlannedRun>& plan,
                                                       const SimulatedExperiment& experiment,
                                                       response::TorqueHold hold,
                                                       const report::FigureOptions& figures);

}  // namespace flexarm::app
