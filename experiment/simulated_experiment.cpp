#include "experiment/simulated_experiment.hpp"

#include "arm/deadline.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "experiment/mode_choice.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/single_modes.hpp"
#include "response/time/step_check.hpp"
#include "response/time/time_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace flexarm::experiment {

namespace {

using response::ArmParts;
using response::RandomNumbers;
using response::SimulationOptions;
using response::SteppedSineOptions;

constexpr std::uint32_t kStreamsOfARun = 1000;

/// A model of the arm with one of the payloads.
struct PayloadModel {
  arm::Payload payload;
  ArmParts parts;
  arm::ModalModel model;
  /// All modes, where those beyond `model` are stepped one by one.
  std::optional<arm::ModalModel> whole = {};
};

/// Models by payload: one is often that of several runs.
class Models {
 public:
  Models(const arm::Arm& arm, const std::vector<arm::Sensor>& sensors,
         const ExperimentOptions& options, const ModeChoice& choice,
         SimulatedExperiment& experiment)
      : arm_(arm), sensors_(sensors), options_(options), choice_(choice), experiment_(experiment) {}

  const PayloadModel& of(const arm::Payload& payload) {
    const auto known = std::ranges::find(models_, payload, &PayloadModel::payload);
    if (known != models_.end()) return *known;
    arm::Arm loaded = arm_;
    loaded.payload = payload;
    PayloadModel made{payload, response::take_apart(loaded), {}};
    const int modes = choice_.coupled;
    const auto chosen =
        options_.formulation.make(made.parts.linear, modes + (options_.static_correction ? 1 : 0));
    made.model = response::time_model(chosen.formulation, made.parts, modes, sensors_,
                                      options_.static_correction);
    experiment_.model = chosen.name;
    experiment_.settings = chosen.settings;
    experiment_.degrees_of_freedom = response::degrees_of_freedom(chosen.formulation);
    experiment_.modes = std::min(modes, static_cast<int>(made.model.modes.size()) - 1);
    if (experiment_.degrees_of_freedom > 0) {
      experiment_.modes = std::min(experiment_.modes, experiment_.degrees_of_freedom - 1);
    }
    if (choice_.truncation.modes > modes) {
      experiment_.modes = choice_.truncation.modes;
      made.whole = response::modal_model(chosen.formulation, experiment_.modes, sensors_, {});
    }
    models_.push_back(std::move(made));
    return models_.back();
  }

 private:
  const arm::Arm& arm_;
  const std::vector<arm::Sensor>& sensors_;
  const ExperimentOptions& options_;
  const ModeChoice& choice_;
  SimulatedExperiment& experiment_;
  std::vector<PayloadModel> models_;
};

void require_finite(const std::vector<double>& reading, const arm::Sensor& sensor,
                    const SimulatedRun& run) {
  const auto wrong = std::ranges::find_if(reading, [](double v) { return !std::isfinite(v); });
  if (wrong == reading.end()) return;
  throw arm::InputError(
      fmt::format("{} at {:.6g} s: numeric overflow", arm::to_string(sensor),
                  run.record.time_s[static_cast<std::size_t>(wrong - reading.begin())]));
}

void compare_steps(SimulatedRun& run, const PayloadModel& model,
                   const std::vector<arm::Sensor>& sensors, const SimulationOptions& options,
                   const ProgressOf& progress_of) {
  const auto& torque_N_m = run.record.torque_N_m;
  const auto finer =
      progress_of(fmt::format("{} in smaller steps, samples", run.id), torque_N_m.size());
  run.step_error = response::check_step(run.simulation, model.model, model.parts, sensors,
                                        torque_N_m, options, finer)
                       .relative_difference;
  if (run.step_error.empty() && !sensors.empty()) throw arm::Cancelled{};
}

/// Adds the readings of the modes that the simulation does not have.
void add_further_modes(SimulatedRun& run, const PayloadModel& model,
                       const std::vector<arm::Sensor>& sensors, const SimulationOptions& options,
                       const ProgressOf& progress_of) {
  const std::size_t first = model.model.modes.size();
  const std::size_t end = model.whole->modes.size();
  const auto progress = progress_of(fmt::format("{}, further modes", run.id), end - first);
  for (std::size_t mode = first; mode < end; ++mode) {
    response::add_readings_of_mode(run.simulation.channels, *model.whole, mode, sensors,
                                   run.simulation.hub_torque_N_m, options.sample_time_s,
                                   options.hold);
    if (!progress(static_cast<double>(mode + 1 - first) / static_cast<double>(end - first))) {
      throw arm::Cancelled{};
    }
  }
}

/// Simulates a run that has its torque, or its loop.
void step(SimulatedRun& run, const PayloadModel& model, const std::vector<arm::Sensor>& sensors,
          const SimulationOptions& options, bool compares_steps, const ProgressOf& progress_of) {
  auto& torque_N_m = run.record.torque_N_m;
  const auto progress = progress_of(fmt::format("{}, samples", run.id), run.record.time_s.size());
  if (run.controller) {
    run.simulation = response::ArmSimulator(model.model, model.parts, sensors, options)
                         .run({*run.controller, run.record.reference.values}, progress);
    torque_N_m = run.simulation.commanded_torque_N_m;
  } else {
    run.simulation = response::simulate(model.model, model.parts, sensors, torque_N_m, options,
                                        std::ref(progress));
  }
  if (!run.simulation.summary.completed) throw arm::Cancelled{};
  if (compares_steps) compare_steps(run, model, sensors, options, progress_of);
  if (model.whole) add_further_modes(run, model, sensors, options, progress_of);
}
/// The random streams of a run begin here.
std::uint32_t first_stream(std::size_t run) {
  return 1 + kStreamsOfARun * static_cast<std::uint32_t>(run);
}

std::vector<arm::Sensor> sensors_of(const std::vector<ChosenSensor>& chosen) {
  std::vector<arm::Sensor> sensors;
  for (const auto& entry : chosen) sensors.push_back(entry.sensor);
  return sensors;
}

/// A run in time; `index` in the plan.
SimulatedRun run_in_time(const PlannedRun& plan, std::size_t index, const arm::Payload& payload,
                         const PayloadModel& model, const std::vector<ChosenSensor>& chosen,
                         const ExperimentOptions& options, const ProgressOf& progress_of) {
  const auto sensors = sensors_of(chosen);
  SimulatedRun run;
  run.id = plan.id;
  run.excitation = plan.excitation;
  run.keys = plan.keys;
  run.lines_Hz = plan.torque.lines_Hz;
  run.detection_Hz = plan.torque.detection_Hz;
  run.payload = payload;
  run.record.time_s = plan.time_s;
  run.record.torque_N_m = plan.torque.torque_N_m;
  run.record.reference = plan.reference;
  run.controller = plan.controller;

  SimulationOptions stepping;
  stepping.sample_time_s = measured::sampling_period_s(run.record);
  stepping.hold = options.hold;
  stepping.substeps = options.substeps;
  const double lowest = model.model.lowest_omega_squared_rad2_per_s2;
  run.fall_rate_rad_per_s = lowest < 0.0 ? std::sqrt(-lowest) : 0.0;
  step(run, model, sensors, stepping, options.check_step, progress_of);
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    auto reading = run.simulation.channels[j];
    run.noise_deviation.push_back(noise_deviation(reading, chosen[j].imperfections));
    RandomNumbers random(options.noise_seed, first_stream(index) + static_cast<std::uint32_t>(j));
    impair(reading, chosen[j].imperfections, random);
    require_finite(reading, sensors[j], run);
    run.record.channels.push_back({sensors[j], std::move(reading)});
  }
  return run;
}

/// A run of a stepped sine.
SteppedSineRun stepped_run(const PlannedRun& plan, std::size_t index, const arm::Payload& payload,
                           const PayloadModel& model, const std::vector<ChosenSensor>& chosen,
                           const ExperimentOptions& options, const ProgressOf& progress_of) {
  SteppedSineRun run{plan.id, plan.keys, payload, sensors_of(chosen), {}};
  SteppedSineOptions stepping;
  stepping.substeps = options.substeps;
  for (const auto& sensor : chosen) stepping.imperfections.push_back(sensor.imperfections);
  stepping.noise_seed = options.noise_seed;
  stepping.first_noise_stream = first_stream(index);
  const auto progress = progress_of(fmt::format("{}, frequencies", run.id),
                                    frequencies_Hz(*plan.stepped_sine).size());
  run.measured = response::measure_stepped_sine(model.model, model.parts, run.sensors,
                                                *plan.stepped_sine, stepping, progress);
  if (!run.measured.summary.completed) throw arm::Cancelled{};
  return run;
}

}  // namespace

void require_valid(const ExperimentOptions& options, const std::vector<PlannedRun>& plan,
                   const std::vector<ChosenSensor>& sensors, const arm::OptionSpelling& spelled) {
  if (options.modes && *options.modes < 1) {
    throw arm::out_of_range(spelled("modes"), *options.modes, "", "1 or more");
  }
  if (options.substeps < 0 || options.substeps > response::kMostSubsteps) {
    throw arm::out_of_range(spelled("substeps"), options.substeps, "",
                            fmt::format("from 0 to {}", response::kMostSubsteps));
  }
  for (const auto& run : plan) {
    if (run.stepped_sine && options.check_step) {
      throw arm::InputError(fmt::format("{}: only for time runs; {} is a stepped sine",
                                        spelled("check-step"), run.id));
    }
    if (!run.controller) continue;
    for (const auto& sensor : run.controller->sensors) {
      if (std::ranges::count(sensors, sensor, &ChosenSensor::sensor) > 0) continue;
      throw arm::InputError(fmt::format("{}: reads {}, which is not among {}",
                                        spelled("controller"), arm::to_string(sensor),
                                        spelled("sensor")));
    }
  }
}

arm::Arm with_hidden_effects(const arm::Arm& arm, const std::vector<std::string>& hidden,
                             std::string_view option) {
  arm::Arm seen = arm;
  std::vector<std::string> names;
  for (const auto& [name, effect] : arm.effects) names.push_back(name);
  names.emplace_back("all");
  for (const auto& name : hidden) {
    if (name == "all") {
      seen.effects.clear();
    } else if (seen.effects.erase(name) == 0) {
      throw arm::InputError(
          fmt::format("{} {}: not an effect of the arm{}; its effects are {}", option,
                      arm::shown(name), arm::did_you_mean(name, names),
                      arm.effects.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    }
  }
  return seen;
}

SimulatedExperiment simulate_experiment(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                                        const std::vector<ChosenSensor>& chosen,
                                        const ExperimentOptions& options,
                                        const ProgressOf& progress_of) {
  const auto sensors = sensors_of(chosen);
  SimulatedExperiment experiment;
  experiment.sensors = sensors;
  ModeChoice choice;
  try {
    choice = choose_modes(arm, runs, sensors, options, progress_of);
  } catch (const arm::Cancelled&) {
    experiment.cancelled = true;
    return experiment;
  }
  experiment.truncation = choice.truncation;
  Models models(arm, sensors, options, choice, experiment);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& plan = runs[i];
    const arm::Payload payload = plan.payload.value_or(arm.payload);
    const PayloadModel& model = models.of(payload);
    try {
      if (plan.stepped_sine) {
        experiment.stepped_runs.push_back(
            stepped_run(plan, i, payload, model, chosen, options, progress_of));
      } else {
        experiment.runs.push_back(
            run_in_time(plan, i, payload, model, chosen, options, progress_of));
        experiment.runs.back().truncation = experiment.truncation;
      }
    } catch (const arm::Cancelled&) {
      experiment.cancelled = true;
      return experiment;
    } catch (const arm::InputError& error) {
      throw arm::InputError(fmt::format("{}: {}", plan.id, error.what()), error.key());
    }
  }
  return experiment;
}

}  // namespace flexarm::experiment
