#include "app/simulated_experiment.hpp"

#include "arm/input_error.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/measurement.hpp"
#include "report/progress.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/step_check.hpp"
#include "response/time/time_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace flexarm::app {

namespace {

constexpr std::uint32_t kStreamsOfARun = 1000;

/// A model of the arm with one of the payloads.
struct PayloadModel {
  arm::Payload payload;
  response::ArmParts parts;
  arm::ModalModel model;
};

/// Models by payload: one is often that of several runs.
class Models {
 public:
  Models(const arm::Arm& arm, const std::vector<arm::Sensor>& sensors,
         const ExperimentOptions& options, SimulatedExperiment& experiment)
      : arm_(arm), sensors_(sensors), options_(options), experiment_(experiment) {}

  const PayloadModel& of(const arm::Payload& payload) {
    const auto known = std::ranges::find(models_, payload, &PayloadModel::payload);
    if (known != models_.end()) return *known;
    arm::Arm loaded = arm_;
    loaded.payload = payload;
    PayloadModel made{payload, response::take_apart(loaded), {}};
    const auto chosen = options_.formulation.make(
        made.parts.linear, options_.modes + (options_.static_correction ? 1 : 0));
    made.model = response::time_model(chosen.formulation, made.parts, options_.modes, sensors_,
                                      options_.static_correction);
    experiment_.model = chosen.name;
    experiment_.settings = chosen.settings;
    experiment_.degrees_of_freedom = response::degrees_of_freedom(chosen.formulation);
    experiment_.modes = std::min(options_.modes, static_cast<int>(made.model.modes.size()) - 1);
    if (experiment_.degrees_of_freedom > 0) {
      experiment_.modes = std::min(experiment_.modes, experiment_.degrees_of_freedom - 1);
    }
    models_.push_back(std::move(made));
    return models_.back();
  }

 private:
  const arm::Arm& arm_;
  const std::vector<arm::Sensor>& sensors_;
  const ExperimentOptions& options_;
  SimulatedExperiment& experiment_;
  std::vector<PayloadModel> models_;
};

/// A line of progress on standard error: how many of `samples` are done.
class SampleProgress {
 public:
  SampleProgress(std::string label, std::size_t samples)
      : line_(std::move(label), static_cast<std::int64_t>(samples)) {}

  bool operator()(double fraction) {
    line_.reach(fraction);
    return true;
  }

 private:
  report::Progress line_;
};

void require_finite(const std::vector<double>& reading, const arm::Sensor& sensor,
                    const report::SimulatedRun& run) {
  const auto wrong = std::ranges::find_if(reading, [](double v) { return !std::isfinite(v); });
  if (wrong == reading.end()) return;
  throw arm::InputError(
      fmt::format("{} at {:.6g} s: numeric overflow", arm::to_string(sensor),
                  run.record.time_s[static_cast<std::size_t>(wrong - reading.begin())]));
}

/// Simulates a run that has its torque, or its loop.
void step(report::SimulatedRun& run, const PayloadModel& model,
          const std::vector<arm::Sensor>& sensors, const response::SimulationOptions& options,
          bool check_step) {
  auto& torque_N_m = run.record.torque_N_m;
  SampleProgress progress(fmt::format("{}, samples", run.id), run.record.time_s.size());
  if (run.controller) {
    run.simulation = response::ArmSimulator(model.model, model.parts, sensors, options)
                         .run({*run.controller, run.record.reference.values}, std::ref(progress));
    torque_N_m = run.simulation.commanded_torque_N_m;
  } else {
    run.simulation = response::simulate(model.model, model.parts, sensors, torque_N_m, options,
                                        std::ref(progress));
  }
  if (!check_step) return;
  SampleProgress finer(fmt::format("{} in smaller steps, samples", run.id), torque_N_m.size());
  run.step_error = response::check_step(run.simulation, model.model, model.parts, sensors,
                                        torque_N_m, options, std::ref(finer))
                       .relative_difference;
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
report::SimulatedRun run_in_time(const PlannedRun& plan, std::size_t index,
                                 const arm::Payload& payload, const PayloadModel& model,
                                 const std::vector<ChosenSensor>& chosen,
                                 const ExperimentOptions& options) {
  const auto sensors = sensors_of(chosen);
  report::SimulatedRun run;
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

  response::SimulationOptions stepping;
  stepping.sample_time_s = measured::sampling_period_s(run.record);
  stepping.hold = options.hold;
  stepping.substeps = options.substeps;
  const double lowest = model.model.lowest_omega_squared_rad2_per_s2;
  run.fall_rate_rad_per_s = lowest < 0.0 ? std::sqrt(-lowest) : 0.0;
  step(run, model, sensors, stepping, options.check_step);
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    auto reading = run.simulation.channels[j];
    run.noise_deviation.push_back(response::noise_deviation(reading, chosen[j].imperfections));
    response::RandomNumbers random(options.noise_seed,
                                   first_stream(index) + static_cast<std::uint32_t>(j));
    response::impair(reading, chosen[j].imperfections, random);
    require_finite(reading, sensors[j], run);
    run.record.channels.push_back({sensors[j], std::move(reading)});
  }
  return run;
}

/// A run of a stepped sine.
report::SteppedSineRun stepped_run(const PlannedRun& plan, std::size_t index,
                                   const arm::Payload& payload, const PayloadModel& model,
                                   const std::vector<ChosenSensor>& chosen,
                                   const ExperimentOptions& options) {
  report::SteppedSineRun run{plan.id, plan.keys, payload, sensors_of(chosen), {}};
  response::SteppedSineOptions stepping;
  stepping.substeps = options.substeps;
  for (const auto& sensor : chosen) stepping.imperfections.push_back(sensor.imperfections);
  stepping.noise_seed = options.noise_seed;
  stepping.first_noise_stream = first_stream(index);
  SampleProgress progress(fmt::format("{}, frequencies", run.id),
                          response::frequencies_Hz(*plan.stepped_sine).size());
  run.measured = response::measure_stepped_sine(model.model, model.parts, run.sensors,
                                                *plan.stepped_sine, stepping, std::ref(progress));
  return run;
}

}  // namespace

SimulatedExperiment simulate_experiment(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                                        const std::vector<ChosenSensor>& chosen,
                                        const ExperimentOptions& options) {
  const auto sensors = sensors_of(chosen);
  SimulatedExperiment experiment;
  Models models(arm, sensors, options, experiment);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& plan = runs[i];
    const arm::Payload payload = plan.payload.value_or(arm.payload);
    const PayloadModel& model = models.of(payload);
    try {
      if (plan.stepped_sine) {
        experiment.stepped_runs.push_back(stepped_run(plan, i, payload, model, chosen, options));
      } else {
        experiment.runs.push_back(run_in_time(plan, i, payload, model, chosen, options));
      }
    } catch (const arm::InputError& error) {
      throw arm::InputError(fmt::format("{}: {}", plan.id, error.what()), error.key());
    }
  }
  return experiment;
}

std::vector<measured::NamedContent> measurement_folder(const std::string& name,
                                                       const arm::Arm& written_arm,
                                                       const std::vector<PlannedRun>& plan,
                                                       const SimulatedExperiment& experiment,
                                                       response::TorqueHold hold,
                                                       const report::FigureOptions& figures) {
  measured::Measurement measurement{name, "arm.toml", {}};
  std::vector<measured::NamedContent> files;
  // Run by run: a figure holds its record.
  const auto add_figures = [&](const std::vector<report::NamedFigure>& of_run) {
    std::ranges::move(report::figure_files(of_run, figures), std::back_inserter(files));
  };
  auto in_time = experiment.runs.begin();
  auto stepped = experiment.stepped_runs.begin();
  for (const auto& planned : plan) {
    measured::Run entry;
    entry.id = planned.id;
    entry.file = planned.id + ".csv";
    entry.purpose = planned.purpose;
    entry.payload = planned.payload;
    if (planned.stepped_sine) {
      entry.kind = measured::RunKind::frf;
      files.push_back(
          {entry.file, measured::format_frequency_record(report::frequency_record(*stepped))});
      add_figures(report::stepped_sine_plots(written_arm.name, *stepped));
      ++stepped;
    } else {
      entry.torque_hold = hold == response::TorqueHold::zero ? measured::TorqueHold::zero
                                                             : measured::TorqueHold::first;
      if (planned.controller) {
        entry.controller = planned.controller;
        entry.reference = measured::ColumnMapping{std::string(measured::kReferenceColumn), "", 1.0};
      }
      files.push_back({entry.file, measured::format_time_record(in_time->record)});
      add_figures({{planned.id, report::simulation_figure(written_arm.name, *in_time)}});
      ++in_time;
    }
    measurement.runs.push_back(std::move(entry));
  }
  files.push_back({"arm.toml", measured::format_arm(written_arm)});
  files.push_back({"measurement.toml", measured::format_measurement(measurement)});
  return files;
}

}  // namespace flexarm::app
