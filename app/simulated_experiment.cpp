#include "app/simulated_experiment.hpp"

#include "arm/arm_file.hpp"
#include "measured/measurement.hpp"
#include "report/progress.hpp"
#include "response/time_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

namespace flexarm::app {

namespace {

constexpr int kFinerSteps = 10;
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
    experiment_.modes = std::min(options_.modes, static_cast<int>(made.model.modes.size()) - 1);
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

response::Simulation simulate(const PayloadModel& arm, const std::vector<arm::Sensor>& sensors,
                              const PlannedRun& run, const response::SimulationOptions& options,
                              const std::string& label) {
  const auto samples = static_cast<std::int64_t>(run.time_s.size());
  report::Progress progress(label, samples);
  std::int64_t shown = 0;
  return response::simulate(
      arm.model, arm.parts, sensors, run.torque.torque_N_m, options, [&](double fraction) {
        const auto done = static_cast<std::int64_t>(fraction * static_cast<double>(samples));
        progress.advance(done - std::exchange(shown, done));
        return true;
      });
}

double largest_size(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Largest difference of each channel over its largest size.
std::vector<double> relative_errors(const response::Simulation& coarse,
                                    const response::Simulation& fine) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < fine.channels.size(); ++i) {
    double worst = 0.0;
    for (std::size_t k = 0; k < fine.channels[i].size(); ++k) {
      worst = std::max(worst, std::abs(coarse.channels[i][k] - fine.channels[i][k]));
    }
    const double scale = largest_size(fine.channels[i]);
    errors.push_back(scale > 0.0 ? worst / scale : 0.0);
  }
  return errors;
}

}  // namespace

SimulatedExperiment simulate_experiment(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                                        const std::vector<ChosenSensor>& chosen,
                                        const ExperimentOptions& options) {
  std::vector<arm::Sensor> sensors;
  for (const auto& entry : chosen) sensors.push_back(entry.sensor);
  SimulatedExperiment experiment;
  Models models(arm, sensors, options, experiment);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& plan = runs[i];
    report::SimulatedRun run;
    run.id = plan.id;
    run.excitation = plan.excitation;
    run.keys = plan.keys;
    run.lines_Hz = plan.torque.lines_Hz;
    run.detection_Hz = plan.torque.detection_Hz;
    run.payload = plan.payload.value_or(arm.payload);
    run.record.time_s = plan.time_s;
    run.record.torque_N_m = plan.torque.torque_N_m;

    const PayloadModel& model = models.of(run.payload);
    response::SimulationOptions stepping;
    stepping.sample_time_s = measured::sampling_period_s(run.record);
    stepping.hold = options.hold;
    stepping.substeps = options.substeps;
    run.simulation = simulate(model, sensors, plan, stepping, fmt::format("{}, samples", plan.id));
    if (options.check_step) {
      stepping.substeps = kFinerSteps * std::max(1, run.simulation.summary.substeps);
      stepping.energy = false;
      run.step_error = relative_errors(
          run.simulation, simulate(model, sensors, plan, stepping,
                                   fmt::format("{} in smaller steps, samples", plan.id)));
    }
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      auto reading = run.simulation.channels[j];
      run.noise_deviation.push_back(response::noise_deviation(reading, chosen[j].imperfections));
      response::RandomNumbers random(
          options.noise_seed,
          1 + static_cast<std::uint32_t>(j) + kStreamsOfARun * static_cast<std::uint32_t>(i));
      response::impair(reading, chosen[j].imperfections, random);
      run.record.channels.push_back({sensors[j], std::move(reading)});
    }
    experiment.runs.push_back(std::move(run));
  }
  return experiment;
}

std::vector<arm::NamedContent> measurement_folder(const std::string& name,
                                                  const arm::Arm& written_arm,
                                                  const std::vector<PlannedRun>& plan,
                                                  const SimulatedExperiment& experiment,
                                                  response::TorqueHold hold) {
  measured::Measurement measurement{name, "arm.toml", {}};
  std::vector<arm::NamedContent> files;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const report::SimulatedRun& run = experiment.runs[i];
    measured::Run entry;
    entry.id = run.id;
    entry.file = run.id + ".csv";
    entry.purpose = plan[i].purpose;
    entry.torque_hold = hold == response::TorqueHold::zero ? measured::TorqueHold::zero
                                                           : measured::TorqueHold::first;
    entry.payload = plan[i].payload;
    files.push_back({entry.file, measured::format_time_record(run.record)});
    files.push_back({run.id + ".svg", report::time_svg(written_arm.name, run)});
    measurement.runs.push_back(std::move(entry));
  }
  files.push_back({"arm.toml", arm::format_arm(written_arm)});
  files.push_back({"measurement.toml", measured::format_measurement(measurement)});
  return files;
}

}  // namespace flexarm::app
