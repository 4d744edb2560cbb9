#include "report/json/simulation_json.hpp"

#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/simulation_report.hpp"
#include "report/tables/stepped_sine_report.hpp"

#include <nlohmann/json.hpp>

namespace flexarm::report {

namespace {

/// Estimated truncation error by sensor, relative to its rms; null where it was not estimated.
nlohmann::ordered_json truncation_json(const experiment::SimulatedExperiment& experiment) {
  const auto& errors = experiment.mode_choice.truncation;
  if (errors.empty()) return nullptr;
  nlohmann::ordered_json by_sensor = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < errors.size(); ++k) {
    by_sensor[arm::to_string(experiment.sensors[k])] = errors[k];
  }
  return by_sensor;
}

}  // namespace

std::string simulation_document(const arm::Arm& arm,
                                const experiment::SimulatedExperiment& experiment,
                                const experiment::ExperimentOptions& options) {
  const char* hold = options.hold == response::TorqueHold::zero ? "zero" : "first";
  return json_document("flexarm.simulate/1",
                       {{"arm", arm_json(arm)},
                        {"model", experiment.model},
                        {"settings", experiment.settings},
                        {"modes", experiment.modes},
                        {"truncation", truncation_json(experiment)},
                        {"static_correction", options.static_correction},
                        {"torque_hold", hold},
                        {"runs", runs_json(experiment.runs)},
                        {"stepped_runs", stepped_runs_json(experiment.stepped_runs)}});
}

}  // namespace flexarm::report
