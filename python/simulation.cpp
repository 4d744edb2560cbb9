#include "arm/input_error.hpp"
#include "experiment/simulated_experiment.hpp"
#include "measured/files/atomic_file.hpp"
#include "python/archive.hpp"
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
#include <pybind11/eval.h>
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

/// The settings of both functions, with their defaults; None: what the program chooses.
constexpr const char* kSettings =
    "sensors=None, duration_s=None, sample_time_s=None, seed=1, noise=0.0, noise_of=None, "
    "quantisation=None, formulation='exact_tf', elements=None, degree=None, basis=None, "
    "functions=None, modes=None, static_correction=False, hold='zero', substeps=0, "
    "check_step=False";

/// The settings that are given, and the defaults of the others. Throws py::type_error for a keyword
/// that is none of them.
py::dict with_defaults(const py::kwargs& given) {
  py::dict settings = py::eval(fmt::format("dict({})", kSettings));
  for (const auto& [name, value] : given) {
    if (!settings.contains(name)) {
      throw py::type_error(fmt::format("unexpected keyword argument '{}'; settings are {}",
                                       name.cast<std::string>(), kSettings));
    }
    settings[name] = value;
  }
  return settings;
}

Settings settings_of(const py::kwargs& keywords) {
  const py::dict all = with_defaults(keywords);
  Settings settings;
  const auto take = [&](const char* name, auto& value) {
    const py::object given = all[name];
    if (given.is_none()) return;
    try {
      value = given.cast<std::remove_reference_t<decltype(value)>>();
    } catch (const py::cast_error&) {
      throw py::type_error(
          fmt::format("{} = {}: must be as in {}", name, std::string(py::repr(given)), kSettings));
    }
  };
  settings.runs.spelled = as_argument;
  settings.sensors.spelled = as_argument;
  take("duration_s", settings.runs.duration_s);
  take("sample_time_s", settings.runs.period_s);
  take("seed", settings.runs.seed);
  settings.options.noise_seed = settings.runs.seed;
  if (!all["sensors"].is_none()) {
    for (const auto& sensor : sensors_of(all["sensors"])) {
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
  take("modes", options.modes);
  take("static_correction", options.static_correction);
  take("substeps", options.substeps);
  take("check_step", options.check_step);
  const auto hold = all["hold"].cast<std::string>();
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
    // At most: the truncation twice; each run, its further modes, and its smaller steps.
    const double pieces = 2.0 + static_cast<double>(experiment.plan.size()) *
                                    (settings.options.check_step ? 3.0 : 2.0);
    double done = -1.0;
    experiment.simulated = experiment::simulate_experiment(
        arm, experiment.plan, sensors, settings.options, [&](const std::string&, std::size_t) {
          done += 1.0;
          return [&state, done, pieces](double fraction) {
            return state.reach((done + fraction) / pieces);
          };
        });
    state.reach(1.0);
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
          "and figures for each run. "
          "Raises InputError where the folder exists.\n\nArguments:\n"
          "  folder: its path\n  name: of the measurement; '': that of the arm\n"
          "  hide_effects: effects left out of the arm file, a list; ['all']: every one")
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

constexpr const char* kSettingsText =
    "  controller: a Controller, 'kp=2,kd=0.1' or the path of its file, with a reference\n"
    "  progress: a callable of the fraction done, None for a line on a terminal or in a notebook, "
    "False for none\n"
    "  sensors: names; None: hub_angle, hub_velocity and, with a beam, tip_acceleration\n"
    "  duration_s: of an excitation [s]; None: 4\n"
    "  sample_time_s: sampling period [s]; None: 0.0005\n"
    "  seed: of the noise, and of excitations without one\n"
    "  noise: standard deviation relative to that of the signal [1]\n"
    "  noise_of: a dict of standard deviations by sensor, in its unit\n"
    "  quantisation: a dict of steps by sensor, in its unit\n"
    "  formulation: 'exact_tf', 'fem', 'assumed_modes' or 'rigid_hub'\n"
    "  elements, degree: of fem; None: chosen\n"
    "  basis, functions: of assumed_modes; None: chosen\n"
    "  modes: flexible modes; None: as many as keep the truncation error below 1e-4\n"
    "  static_correction: whether a residual mode stands for the omitted ones\n"
    "  hold: torque between samples, 'zero' (constant) or 'first' (linear)\n"
    "  substeps: inner steps a sample; 0: chosen\n"
    "  check_step: whether the step is halved to estimate its error\n\n"
    "Ctrl-C ends it. Raises InputError.";

}  // namespace

void add_simulation(py::module_& module) {
  add_experiment(module);
  const auto text = [](const std::string& of_one) {
    return fmt::format("{}\n--\n\n{}{}", kSettings, of_one, kSettingsText);
  };
  module.def(
      "simulate", &simulate, py::arg("arm"), py::arg("excitation") = py::none(), py::kw_only(),
      py::arg("reference") = py::none(), py::arg("controller") = py::none(),
      py::arg("progress") = py::none(),
      text(
          "The time response of an arm at rest, all effects included: SimulatedRun.\n\nArguments:\n"
          "  arm: the Arm\n"
          "  excitation: a torque [N m], array (samples,), or 'KIND:KEY=VALUE,...' as for "
          "`flexarm simulate --excitation`; None: bang-bang\n"
          "  reference: of a closed loop in place of the excitation, an array in the unit of the "
          "controller's sensor or such a text\n")
          .c_str());
  module.def(
      "simulate_experiment", &simulate_experiment, py::arg("arm"), py::arg("excitations"),
      py::kw_only(), py::arg("references") = py::none(), py::arg("controller") = py::none(),
      py::arg("progress") = py::none(),
      text("Several runs of an arm: SimulatedExperiment.\n\nArguments:\n"
           "  arm: the Arm\n"
           "  excitations: a list of 'KIND:KEY=VALUE,...', which may have id, payload [kg] and "
           "purpose\n"
           "  references: of closed loops, a list of such texts\n")
          .c_str());
  module.def("sampled_torque", &sampled_torque, py::arg("excitation"), py::kw_only(),
             py::arg("duration_s") = experiment::kDefaultDuration_s,
             py::arg("sample_time_s") = experiment::kDefaultPeriod_s,
             "The torque of an excitation [N m], array (samples,). Raises InputError.\n\n"
             "Arguments:\n  excitation: 'KIND:KEY=VALUE,...'\n  duration_s: its duration [s]\n"
             "  sample_time_s: sampling period [s]");
  add_pickle<Experiment>();
}

}  // namespace flexarm::python
