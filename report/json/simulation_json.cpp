#include "report/json/simulation_json.hpp"

#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/simulation_report.hpp"
#include "report/tables/stepped_sine_report.hpp"
#include "report/tables/truncation_text.hpp"

#include <nlohmann/json.hpp>

namespace flexarm::report {

std::string simulation_document(const arm::Arm& arm,
                                const experiment::SimulatedExperiment& experiment,
                                const experiment::ExperimentOptions& options) {
  const char* hold = options.hold == response::TorqueHold::zero ? "zero" : "first";
  return json_document("flexarm.simulate/1",
                       {{"arm", arm_json(arm)},
                        {"model", experiment.model},
                        {"settings", experiment.settings},
                        {"modes", experiment.modes},
                        {"static_correction", options.static_correction},
                        {"truncation", truncation_json(experiment.truncation, experiment.sensors)},
                        {"torque_hold", hold},
                        {"runs", runs_json(experiment.runs)},
                        {"stepped_runs", stepped_runs_json(experiment.stepped_runs)}});
}

}  // namespace flexarm::report
