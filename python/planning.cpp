#include "diagnose/planning/plan_task.hpp"
#include "measured/files/atomic_file.hpp"
#include "python/archive.hpp"
#include "python/argument_names.hpp"
#include "python/arm.hpp"
#include "python/long_call.hpp"
#include "python/module.hpp"
#include "report/json/plan_json.hpp"
#include "report/tables/plan_tables.hpp"

#include <fmt/format.h>

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

using diagnose::Detection;
using diagnose::Plan;
using Texts = std::vector<std::string>;

std::optional<std::map<std::string, double>> values_of(
    const Detection& detection, const std::optional<diagnose::Candidate>& candidate) {
  if (!candidate) return std::nullopt;
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < detection.hypothesis.parameters.size(); ++i) {
    values[detection.hypothesis.parameters[i].name] = candidate->values[i];
  }
  return values;
}

Plan plan(const py::object& arm, const std::filesystem::path& plan_file, const Texts& effects,
          const Texts& refit, const py::object& progress) {
  const arm::Arm of = arm_of(arm);
  return long_call("plan", progress, [&](CallState& state) {
    const auto task =
        diagnose::plan_task(of, diagnose::read_measurement_plan(plan_file),
                            {.effects = effects, .refitted = refit, .spelled = as_argument});
    return diagnose::plan_experiment(
        task.arm, task.planned, task.hypotheses, task.options,
        [&](std::string_view, double fraction) { return state.reach(fraction); });
  });
}

Texts labels(const Plan& plan, const std::vector<std::size_t>& effects) {
  Texts names;
  for (const std::size_t i : effects) names.push_back(plan.effects[i].hypothesis.label());
  return names;
}

}  // namespace

void add_planning(py::module_& module) {
  py::class_<Detection>(module, "Detection", "What a planned experiment shows of an effect.")
      .def_property_readonly(
          "effect", [](const Detection& self) { return self.hypothesis.label(); },
          "'coulomb_friction', 'sensor_lag on tip_acceleration'.")
      .def_readonly("is_detectable", &Detection::shows, "Somewhere in its range.")
      .def_property_readonly(
          "minimum_detectable_value",
          [](const Detection& self) { return values_of(self, self.smallest); },
          "The smallest values that would be identified, a dict by parameter; None where there are "
          "none.")
      .def("__repr__", [](const Detection& self) {
        return fmt::format("<flexarm.Detection {}: {}>", self.hypothesis.label(),
                           self.shows ? "detectable" : "not detectable");
      });
  py::class_<Plan>(module, "Plan", "What a planned experiment can say of the effects.")
      .def_readonly("effects", &Plan::effects, "A list of Detection.")
      .def_property_readonly(
          "indistinguishable",
          [](const Plan& self) {
            std::vector<Texts> classes;
            for (const auto& one : self.classes) classes.push_back(labels(self, one));
            return classes;
          },
          "Effects that the runs do not distinguish, a list of lists of names.")
      .def_readonly("notices", &Plan::notices, "What was assumed, a list of sentences.")
      .def_property_readonly(
          "summary", [](const Plan& self) { return report::plan_summary(self); },
          "The result in a few sentences.")
      .def_property_readonly(
          "improved_plan",
          [](const Plan& self) { return diagnose::format_measurement_plan(self.better); },
          "The plan with the recommended runs, the text of a measurement-plan.toml.")
      .def("to_json", &report::plan_document,
           "The text that `flexarm plan --json` writes (docs/json.md).")
      .def("__repr__", [](const Plan& self) {
        return fmt::format("<flexarm.Plan: {} effects, {} indistinguishable classes>",
                           self.effects.size(), self.classes.size());
      });
  module.def(
      "plan", &plan, py::arg("arm"), py::arg("plan_file"), py::kw_only(),
      py::arg("effects") = Texts{}, py::arg("refit") = Texts{}, py::arg("progress") = py::none(),
      "What the runs of a measurement-plan.toml would say of the effects of an arm: Plan. Ctrl-C "
      "ends it. Raises InputError.\n\nArguments:\n"
      "  arm: an Arm, or the path of an arm file\n"
      "  plan_file: path of the measurement-plan.toml\n"
      "  effects: names of the effects to look at, a list; []: all\n"
      "  refit: names of those whose size is not known, a list\n"
      "  progress: as in simulate");
  add_pickle<Detection, Plan>();
}

}  // namespace flexarm::python
