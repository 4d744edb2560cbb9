#pragma once

#include "experiment/run_choice.hpp"
#include "experiment/sensor_choice.hpp"
#include "response/formulation_choice.hpp"
#include "response/time/simulation.hpp"
#include "response/time/stepped_sine_response.hpp"
#include "response/truncation.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::experiment {

/// A run of a simulated experiment.
struct SimulatedRun {
  std::string id;
  std::string excitation;                     ///< "bang-bang", "torque.csv"
  std::vector<response::ExcitationKey> keys;  ///< its numbers; none for a torque from a file
  std::vector<double> lines_Hz;               ///< of a multisine
  std::vector<double> detection_Hz;           ///< its lines that were left out
  arm::Payload payload;
  measured::TimeRecord record;          ///< as the sensors read it, noise and all
  response::Simulation simulation;      ///< without their noise; channels in the record's order
  std::vector<double> noise_deviation;  ///< one a channel, in its unit
  double fall_rate_rad_per_s = 0.0;  ///< of an arm that stands up: undamped poles +- this; else 0
  std::vector<double> step_error;  ///< one a channel: largest difference to a tenfold smaller step,
                                   ///< over the largest size; empty when not asked for
  std::optional<arm::Controller> controller = {};  ///< of a closed loop; its excitation is the
                                                   ///< record's reference
  response::Truncation truncation = {};            ///< SimulatedExperiment::truncation
};

/// A run of a simulated experiment that measured a frequency response sine by sine.
struct SteppedSineRun {
  std::string id;
  std::vector<response::ExcitationKey> keys;
  arm::Payload payload;
  std::vector<arm::Sensor> sensors;
  response::SteppedSineResponse measured;  ///< noise and all
};

/// How an experiment is simulated.
struct ExperimentOptions {
  response::FormulationChoice formulation;
  std::optional<int> modes = {};  ///< flexible ones; empty: chosen (response/truncation.hpp)
  bool static_correction = false;
  response::TorqueHold hold = response::TorqueHold::zero;
  int substeps = 0;
  bool check_step = false;
  std::uint64_t noise_seed = 1;
};

/// The runs of an experiment on one arm, and the model that they were simulated with.
struct SimulatedExperiment {
  std::string model;     ///< "exact_tf"
  std::string settings;  ///< empty for exact_tf
  int modes = 0;         ///< flexible ones kept
  /// The largest errors of all runs; one a sensor of the experiment.
  response::Truncation truncation = {};
  std::vector<arm::Sensor> sensors = {};
  int degrees_of_freedom = 0;  ///< of the model; 0 for exact_tf
  std::vector<SimulatedRun> runs;
  std::vector<SteppedSineRun> stepped_runs;  ///< those of the plan that are stepped sines
  bool cancelled = false;                    ///< there are the runs before that
};

/// Throws InputError, with options named as `spelled` does, for numbers of `options` out of their
/// range, options that a stepped sine of the plan has no use for, and sensors that a controller of
/// the plan reads and that are not simulated.
void require_valid(const ExperimentOptions& options, const std::vector<PlannedRun>& plan,
                   const std::vector<ChosenSensor>& sensors, const arm::OptionSpelling& spelled);

/// The arm with some of its effects, or with none of them ("all"): what a blind test of a diagnosis
/// is given. Throws InputError, which begins with `option`, for an effect that the arm does not
/// have.
arm::Arm with_hidden_effects(const arm::Arm& arm, const std::vector<std::string>& hidden,
                             std::string_view option);

/// Makes the progress function of a piece of work: "random, samples", of so many of them. It
/// returns false where the experiment is to end.
using ProgressOf =
    std::function<response::SimulationProgress(const std::string& label, std::size_t total)>;

/// Simulates every run. Throws InputError, with the run's id in front, as `simulate` and
/// `measure_stepped_sine`.
SimulatedExperiment simulate_experiment(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                                        const std::vector<ChosenSensor>& sensors,
                                        const ExperimentOptions& options,
                                        const ProgressOf& progress_of);

}  // namespace flexarm::experiment
