#include "arm/input_error.hpp"
#include "experiment/simulated_experiment.hpp"
#include "measured/files/atomic_file.hpp"
#include "python/argument_names.hpp"
#include "python/arm.hpp"
#include "python/arrays.hpp"
#include "python/long_call.hpp"
#include "python/module.hpp"
#include "report/json/simulation_json.hpp"
#include "report/measurement_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <map>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using experiment::SimulatedRun;
using Texts = std::vector<std::string>;

/// A simulated experiment with what it was made of.
struct Experiment {
  arm::Arm arm;
  std::vector<experiment::PlannedRun> plan;
  experiment::ExperimentOptions options;
  experiment::SimulatedExperiment simulated;
};

/// What all simulations may be told.
struct Settings {
  experiment::RunChoice runs;
  experiment::SensorChoice sensors;
  experiment::ExperimentOptions options;
};

std::vector<std::string> pairs(const std::map<std::string, double>& numbers) {
  std::vector<std::string> texts;
  for (const auto& [sensor, number] : numbers)
    texts.push_back(fmt::format("{}={}", sensor, number));
  return texts;
}

/// The arguments that both functions have, as `add_settings` names them.
Settings settings_of(const py::kwargs& given) {
  Settings settings;
  std::set<std::string> known = {"sensors"};
  const auto take = [&](const char* name, auto& value) {
    known.insert(name);
    if (given.contains(name) && !given[name].is_none()) {
      value = given[name].cast<std::remove_reference_t<decltype(value)>>();
    }
  };
  settings.runs.spelled = as_argument;
  settings.sensors.spelled = as_argument;
  take("duration_s", settings.runs.duration_s);
  take("sample_time_s", settings.runs.period_s);
  take("seed", settings.runs.seed);
  settings.options.noise_seed = settings.runs.seed;
  if (given.contains("sensors") && !given["sensors"].is_none()) {
    for (const auto& sensor : sensors_of(given["sensors"])) {
      settings.sensors.names.push_back(arm::to_string(sensor));
    }
  }
  take("noise", settings.sensors.relative_noise);
  std::map<std::string, double> noise_of;
  std::map<std::string, double> quantisation;
  take("noise_of", noise_of);
  take("quantisation", quantisation);
  settings.sensors.noises = pairs(noise_of);
  settings.sensors.quantisations = pairs(quantisation);
  auto& options = settings.options;
  options.formulation.spelled = as_argument;
  take("formulation", options.formulation.name);
  take("elements", options.formulation.elements);
  take("degree", options.formulation.degree);
  take("basis", options.formulation.basis);
  take("functions", options.formulation.functions);
  known.insert("modes");
  if (given.contains("modes") && !given["modes"].is_none()) {
    options.modes = given["modes"].cast<int>();
  }
  take("static_correction", options.static_correction);
  take("substeps", options.substeps);
  take("check_step", options.check_step);
  std::string hold = "zero";
  take("hold", hold);
  for (const auto& [name, value] : given) {
    if (known.contains(name.cast<std::string>())) continue;
    throw py::type_error(fmt::format("unexpected keyword argument '{}'; further arguments are {}",
                                     name.cast<std::string>(), fmt::join(known, ", ")));
  }
  if (hold != "zero" && hold != "first") {
    throw arm::InputError(fmt::format(
        "hold {}: must be zero (zero-order hold) or first (first-order hold)", arm::shown(hold)));
  }
  options.hold = hold == "zero" ? response::TorqueHold::zero : response::TorqueHold::first;
  return settings;
}

/// Numbers over time as a record: a torque, or the reference of a loop.
measured::TimeRecord record_of(const Numbers& values, double sample_time_s, const char* argument) {
  measured::TimeRecord record;
  record.torque_N_m = one_dimensional(values, argument);
  const std::size_t samples = record.torque_N_m.size();
  if (samples < 2) {
    throw arm::InputError(fmt::format("{}: {} samples; must be 2 or more", argument, samples));
  }
  arm::require_in_range("sample_time_s", sample_time_s, "s", arm::kPositive);
  const response::SampleGrid grid{samples, sample_time_s};
  for (std::size_t k = 0; k < samples; ++k) record.time_s.push_back(grid.time_s(k));
  record.reference.values = record.torque_N_m;
  return record;
}

void set_controller(experiment::RunChoice& runs, const py::object& controller) {
  if (controller.is_none()) return;
  if (py::isinstance<py::str>(controller)) {
    runs.controller = controller.cast<std::string>();
  } else {
    runs.loop = controller.cast<arm::Controller>();
  }
}

Experiment simulated(const arm::Arm& arm, const Settings& settings, const py::object& progress) {
  return long_call("simulation", progress, [&](CallState& state) {
    Experiment experiment{arm, settings.runs.runs(arm, {}), settings.options, {}};
    const auto sensors = settings.sensors.sensors(arm);
    experiment::require_valid(settings.options, experiment.plan, sensors, as_argument);
    const double pieces =
        static_cast<double>(experiment.plan.size()) * (settings.options.check_step ? 2.0 : 1.0);
    double done = -1.0;
    experiment.simulated = experiment::simulate_experiment(
        arm, experiment.plan, sensors, settings.options, [&](const std::string&, std::size_t) {
          done += 1.0;
          return [&state, done, pieces](double fraction) {
            return state.reach((done + fraction) / pieces);
          };
        });
    return experiment;
  });
}

Experiment simulate_experiment(const arm::Arm& arm, const Texts& excitations,
                               const py::object& references, const py::object& controller,
                               const py::object& progress, const py::kwargs& given) {
  Settings settings = settings_of(given);
  settings.runs.excitations = excitations;
  if (!references.is_none()) settings.runs.references = references.cast<Texts>();
  set_controller(settings.runs, controller);
  return simulated(arm, settings, progress);
}

SimulatedRun simulate(const arm::Arm& arm, const py::object& excitation,
                      const py::object& reference, const py::object& controller,
                      const py::object& progress, const py::kwargs& given) {
  Settings settings = settings_of(given);
  auto& runs = settings.runs;
  const double sample_time_s = runs.period_s.value_or(experiment::kDefaultPeriod_s);
  if (!excitation.is_none() && !reference.is_none()) {
    throw arm::InputError("excitation: not together with reference");
  }
  if (py::isinstance<py::str>(excitation)) {
    runs.excitations = {excitation.cast<std::string>()};
  } else if (!excitation.is_none()) {
    runs.torque_records = {record_of(excitation.cast<Numbers>(), sample_time_s, "excitation")};
    runs.period_s.reset();
  }
  if (py::isinstance<py::str>(reference)) {
    runs.references = {reference.cast<std::string>()};
  } else if (!reference.is_none()) {
    runs.reference_records = {record_of(reference.cast<Numbers>(), sample_time_s, "reference")};
    runs.period_s.reset();
  }
  set_controller(runs, controller);
  Experiment experiment = simulated(arm, settings, progress);
  if (experiment.simulated.runs.empty()) {
    throw arm::InputError("excitation stepped-sine: only for simulate_experiment");
  }
  return std::move(experiment.simulated.runs.front());
}

py::array_t<double> sampled_torque(const std::string& excitation, double duration_s,
                                   double sample_time_s) {
  experiment::RunChoice runs;
  runs.spelled = as_argument;
  runs.excitations = {excitation};
  runs.duration_s = duration_s;
  runs.period_s = sample_time_s;
  return owned(std::move(runs.runs(arm::paper_arm(), {}).front().torque.torque_N_m));
}

void write(const Experiment& experiment, const std::filesystem::path& folder,
           const std::string& name, const Texts& hide_effects) {
  const arm::Arm written =
      experiment::with_hidden_effects(experiment.arm, hide_effects, "hide_effects");
  const py::gil_scoped_release without_lock;
  measured::write_folder_atomically(
      folder,
      report::measurement_folder(name.empty() ? report::simulated_name(experiment.arm) : name,
                                 written, experiment.plan, experiment.simulated,
                                 experiment.options.hold, {}),
      measured::IfExists::refuse);
}

void add_experiment(py::module_& module) {
  py::class_<Experiment>(module, "SimulatedExperiment",
                         "Simulated runs, as `flexarm simulate` makes them.")
      .def_property_readonly(
          "runs", [](const Experiment& self) { return self.simulated.runs; },
          "The time runs, a list of SimulatedRun.")
      .def_property_readonly(
          "stepped_runs", [](const Experiment& self) { return self.simulated.stepped_runs; },
          "The stepped-sine runs, a list of SteppedSineRun.")
      .def_property_readonly(
          "model", [](const Experiment& self) { return self.simulated.model; },
          "Name of the formulation.")
      .def_property_readonly(
          "truncation_errors",
          [](const Experiment& self) { return self.simulated.truncation.errors; },
          "Estimated error of each sensor by the omitted modes, relative to its signal, a list; "
          "the "
          "largest of all runs.")
      .def_property_readonly(
          "modes", [](const Experiment& self) { return self.simulated.modes; },
          "Flexible modes that were kept.")
      .def(
          "write", &write, py::arg("folder"), py::kw_only(), py::arg("name") = "",
          py::arg("hide_effects") = Texts{},
          "Writes a new folder as `flexarm simulate --out`: measurement.toml, arm.toml, a CSV file "
          "and figures for each run. hide_effects=['all'] leaves effects out of the arm file. "
          "Raises InputError where the folder exists.")
      .def(
          "to_json",
          [](const Experiment& self) {
            return report::simulation_document(self.arm, self.simulated, self.options);
          },
          "The text that `flexarm simulate --json` writes (docs/json.md).")
      .def("__repr__", [](const Experiment& self) {
        std::vector<std::string> ids;
        for (const auto& run : self.plan) ids.push_back(run.id);
        return fmt::format("<flexarm.SimulatedExperiment by {}, {} modes: {}>",
                           self.simulated.model, self.simulated.modes, fmt::join(ids, ", "));
      });
}

constexpr const char* kSettings =
    "\n\nFurther arguments, as the options of `flexarm simulate`: sensors (None: hub_angle, "
    "hub_velocity and, with a beam, tip_acceleration), duration_s (4), sample_time_s (0.0005), "
    "seed (1), noise (standard deviation relative to that of the signal), noise_of and "
    "quantisation (dicts by sensor, in its unit), formulation ('exact_tf') with elements, degree, "
    "basis and functions, modes (None: as many as keep the truncation error below 1e-4), "
    "static_correction (False), hold ('zero' or 'first'), substeps "
    "(0) and check_step (False). progress: a callable of the fraction done, None for a line on a "
    "terminal or in a notebook, False for none. Ctrl-C ends it. Raises InputError.";

}  // namespace

void add_simulation(py::module_& module) {
  add_experiment(module);
  module.def(
      "simulate", &simulate, py::arg("arm"), py::arg("excitation") = py::none(), py::kw_only(),
      py::arg("reference") = py::none(), py::arg("controller") = py::none(),
      py::arg("progress") = py::none(),
      (std::string("The time response of an arm at rest, all effects included: SimulatedRun. "
                   "`excitation` is a torque [N m], array (samples,), or "
                   "'KIND:KEY=VALUE,...' as for `flexarm simulate --excitation`. In closed loop "
                   "`reference`, an array in the unit of the controller's sensor or such a text, "
                   "takes its place, with a Controller or 'kp=2,kd=0.1' or the path of its file.") +
       kSettings)
          .c_str());
  module.def("simulate_experiment", &simulate_experiment, py::arg("arm"), py::arg("excitations"),
             py::kw_only(), py::arg("references") = py::none(), py::arg("controller") = py::none(),
             py::arg("progress") = py::none(),
             (std::string("Several runs of an arm, each 'KIND:KEY=VALUE,...', which may have id, "
                          "payload [kg] and purpose: SimulatedExperiment.") +
              kSettings)
                 .c_str());
  module.def("sampled_torque", &sampled_torque, py::arg("excitation"), py::kw_only(),
             py::arg("duration_s") = experiment::kDefaultDuration_s,
             py::arg("sample_time_s") = experiment::kDefaultPeriod_s,
             "The torque of an excitation 'KIND:KEY=VALUE,...' [N m], array (samples,). Raises "
             "InputError.");
}

}  // namespace flexarm::python
