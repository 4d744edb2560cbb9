#include "diagnose/diagnosis.hpp"

#include "arm/input_error.hpp"
#include "arm/unit_suffix.hpp"
#include "diagnose/diagnosis_request.hpp"
#include "python/archive.hpp"
#include "python/argument_names.hpp"
#include "python/arrays.hpp"
#include "python/long_call.hpp"
#include "python/measurements.hpp"
#include "python/module.hpp"
#include "report/figures/diagnosis_figures.hpp"
#include "report/figures/figure_files.hpp"
#include "report/json/diagnosis_document.hpp"
#include "report/tables/diagnosis_tables.hpp"
#include "report/tables/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
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

using diagnose::Cause;
using diagnose::Gain;
using diagnose::ParameterEstimate;
using diagnose::RefittedNumber;
using diagnose::Symptom;
using Texts = std::vector<std::string>;

/// A diagnosis with the experiment that it is of.
struct Diagnosed {
  diagnose::Experiment experiment;
  diagnose::Diagnosis diagnosis;
};

/// A channel as it was measured and simulated.
struct RunOverlay {
  std::string run;
  diagnose::Overlay overlay;
};

Diagnosed diagnose_measurement(const py::object& measurement, const Texts& effects,
                               const Texts& exclude, const Texts& accept,
                               std::optional<double> time_limit_s, std::optional<int> max_causes,
                               const std::string& predictor,
                               const std::map<std::string, double>& policy,
                               const py::object& progress) {
  const auto begun = std::chrono::steady_clock::now();
  Texts numbers;
  for (const auto& [name, value] : policy) numbers.push_back(fmt::format("{}={}", name, value));
  const diagnose::DiagnosisRequest request{.effects = effects,
                                           .excluded = exclude,
                                           .accepted = accept,
                                           .time_limit_s = time_limit_s,
                                           .most_causes = max_causes,
                                           .predictor = predictor,
                                           .policy = numbers,
                                           .spelled = as_argument};
  const MeasurementSource source = measurement_source(measurement);
  return long_call("diagnosis", progress, [&](CallState& state) {
    const auto deadline = diagnose::deadline_of(request, begun);
    Diagnosed diagnosed{diagnose::experiment_of(recording_of(source), request, deadline), {}};
    diagnosed.diagnosis =
        diagnose::diagnose(diagnosed.experiment, request, deadline,
                           [&](std::string_view, double done) { return state.reach(done); });
    return diagnosed;
  });
}

std::vector<RunOverlay> overlays_of(const Diagnosed& self) {
  std::vector<RunOverlay> overlays;
  for (const auto& overlay : self.diagnosis.overlays) {
    overlays.push_back({self.experiment.runs[overlay.run].run.id, overlay});
  }
  return overlays;
}

std::map<std::string, std::string> figures_of(const Diagnosed& self) {
  const py::gil_scoped_release without_lock;
  std::map<std::string, std::string> figures;
  for (auto& file :
       report::figure_files(report::diagnosis_plots(self.experiment, self.diagnosis).plots)) {
    figures[file.name] = std::move(file.content);
  }
  return figures;
}

std::string number_with_error(const ParameterEstimate& estimate) {
  const std::string unit = arm::unit_suffix(estimate.unit);
  return fmt::format("{} {:.4g} +- {:.2g}{}", estimate.name, estimate.value, estimate.std_error,
                     unit);
}

std::string cause_text(const Cause& cause) {
  Texts numbers;
  for (const auto& parameter : cause.parameters) numbers.push_back(number_with_error(parameter));
  return fmt::format("<flexarm.Cause {}: {}, probability {:.2g}>", cause.label(),
                     fmt::join(numbers, ", "), cause.confidence);
}

void add_estimates(py::module_& module) {
  py::class_<ParameterEstimate>(module, "ParameterEstimate", "An estimated parameter.")
      .def_readonly("name", &ParameterEstimate::name, "Its name in an arm file.")
      .def_readonly("value", &ParameterEstimate::value, "In `unit`.")
      .def_readonly("std_error", &ParameterEstimate::std_error, "Standard error, in `unit`.")
      .def_readonly("unit", &ParameterEstimate::unit, "'1' for a plain number.")
      .def("__repr__", [](const ParameterEstimate& self) {
        return fmt::format("<flexarm.ParameterEstimate {}>", number_with_error(self));
      });
  py::class_<Cause>(module, "Cause", "An effect that the arm file lacks.")
      .def_readonly("effect", &Cause::effect, "Its name.")
      .def_readonly("sensor", &Cause::sensor, "The sensor it acts on, '' where it acts on none.")
      .def_property_readonly(
          "parameters",
          [](const Cause& self) {
            std::map<std::string, ParameterEstimate> parameters;
            for (const auto& one : self.parameters) parameters[one.name] = one;
            return parameters;
          },
          "Its parameters by name, a dict of ParameterEstimate.")
      .def_readonly("probability", &Cause::confidence,
                    "Posterior probability, `confidence` of the JSON.")
      .def_readonly("class_probability", &Cause::class_confidence,
                    "Of this effect or one that is indistinguishable from it.")
      .def_property_readonly(
          "explained_share", [](const Cause& self) { return report::explained_share(self.share); },
          "Of the excess residual without it, 0 to 1.")
      .def_readonly("confusable_with", &Cause::confusable_with,
                    "Effects that these data do not distinguish from it, a list.")
      .def_property_readonly(
          "grade",
          [](const Cause& self) -> std::optional<std::string> {
            if (!self.figures) return std::nullopt;
            return std::string(to_string(self.grade));
          },
          "'established', 'supported' or 'candidate'; None where a time limit left no time for it.")
      .def_readonly("family", &Cause::family, "Of effects that act at one place, in words.")
      .def_readonly("names_family", &Cause::names_family,
                    "Whether all of `confusable_with` are of the family: the data determine it and "
                    "not which of its effects acts.")
      .def_readonly("evidence", &Cause::evidence, "Sentences, a list.")
      .def_readonly("evidence_against", &Cause::refuted_by, "What would speak against it.")
      .def("__repr__", &cause_text);
  py::class_<RefittedNumber>(module, "RefittedNumber", "An uncertain number that was refitted.")
      .def_readonly("key", &RefittedNumber::key, "Its key in the arm file.")
      .def_readonly("nominal_value", &RefittedNumber::file_value, "That of the file, in `unit`.")
      .def_readonly("uncertainty", &RefittedNumber::uncertainty, "Relative, of the file [1].")
      .def_readonly("value", &RefittedNumber::value, "As refitted, in `unit`.")
      .def_readonly("std_error", &RefittedNumber::std_error, "Standard error, in `unit`.")
      .def_readonly("unit", &RefittedNumber::unit, "Its unit.");
}

void add_residuals(py::module_& module) {
  py::class_<Gain>(module, "Gain", "Relative errors of the simulation, NRMSE as a fraction.")
      .def_readonly("before", &Gain::before, "Of the arm file.")
      .def_readonly("after", &Gain::after, "Of the extended arm.")
      .def_readonly("noise_floor", &Gain::noise_floor, "Of the sensors.")
      .def_readonly("numerical_error", &Gain::numerical_error, "Of the simulation.")
      .def("__repr__", [](const Gain& self) {
        return fmt::format("<flexarm.Gain NRMSE {:.3g} % before, {:.3g} % after>",
                           100.0 * self.before, 100.0 * self.after);
      });
  const auto numbers = [](std::vector<double> diagnose::Overlay::*member) {
    return [member](const py::object& self) {
      return view<double>(self.cast<const RunOverlay&>().overlay.*member, self);
    };
  };
  py::class_<RunOverlay>(
      module, "Overlay",
      "A channel as it was measured and as the arm file and the extended arm "
      "have it, read-only arrays. Of frf data, where an array has the real parts and then the "
      "imaginary parts, and of modal data they are those of the residuals.")
      .def_readonly("run", &RunOverlay::run, "Id of the run.")
      .def_property_readonly(
          "sensor", [](const RunOverlay& self) { return self.overlay.sensor; }, "The sensor.")
      .def_property_readonly("measured", numbers(&diagnose::Overlay::measured), "As measured.")
      .def_property_readonly("before", numbers(&diagnose::Overlay::before),
                             "Simulated with the arm file.")
      .def_property_readonly("after", numbers(&diagnose::Overlay::after),
                             "Simulated with the extended arm.");
  py::class_<Symptom>(module, "Symptom", "A finding of the residual analysis.")
      .def_property_readonly(
          "kind", [](const Symptom& self) { return std::string(to_string(self.kind)); },
          "'error', 'trend', 'roots', 'hub_torque', 'distortion' or 'drift'.")
      .def_readonly("text", &Symptom::text, "A sentence or two.")
      .def_readonly("p_value", &Symptom::probability, "Corrected for the number of tests.")
      .def_readonly("is_significant", &Symptom::is_significant, "p-value below 0.001.")
      .def_readonly("run", &Symptom::run, "Where it is of one.")
      .def_readonly("sensor", &Symptom::sensor, "Where it is of one.")
      .def("__repr__",
           [](const Symptom& self) { return fmt::format("<flexarm.Symptom {}>", self.text); });
}

}  // namespace

void add_diagnosis(py::module_& module) {
  add_estimates(module);
  add_residuals(module);
  py::class_<Diagnosed>(module, "Diagnosis",
                        "What the simulation of an arm file gets wrong, and why.")
      .def_property_readonly(
          "verdict",
          [](const Diagnosed& self) { return std::string(to_string(self.diagnosis.verdict)); },
          "'adequate', 'explained', 'partly_explained' or 'unexplained'.")
      .def_property_readonly(
          "verdict_text",
          [](const Diagnosed& self) { return report::verdict_text(self.diagnosis); },
          "The verdict in a sentence or two.")
      .def_property_readonly(
          "causes", [](const Diagnosed& self) { return self.diagnosis.causes; },
          "The effects that the arm file lacks, a list of Cause, the largest share first.")
      .def_property_readonly(
          "something_else", [](const Diagnosed& self) { return self.diagnosis.something_else; },
          "Posterior probability of a cause outside the library.")
      .def_property_readonly(
          "symptoms", [](const Diagnosed& self) { return self.diagnosis.symptoms.statements; },
          "Findings of the residual analysis of the baseline, a list of Symptom, the significant "
          "ones "
          "first.")
      .def_property_readonly(
          "refitted", [](const Diagnosed& self) { return self.diagnosis.refitted; },
          "Uncertain numbers as refitted, a list of RefittedNumber.")
      .def_property_readonly(
          "predictor",
          [](const Diagnosed& self) { return std::string(to_string(self.diagnosis.predictor)); },
          "How time runs were predicted.")
      .def_property_readonly(
          "estimation", [](const Diagnosed& self) { return self.diagnosis.estimation; },
          "Gain on the runs that were fitted.")
      .def_property_readonly(
          "validation", [](const Diagnosed& self) { return self.diagnosis.validation; },
          "Gain on the validation runs; None without any.")
      .def_property_readonly(
          "arm", [](const Diagnosed& self) { return self.experiment.arm; }, "The arm of the file.")
      .def_property_readonly(
          "extended_arm",
          [](const Diagnosed& self) -> std::optional<arm::Arm> {
            if (!diagnose::has_extended_arm(self.diagnosis)) return std::nullopt;
            return self.diagnosis.extended_arm;
          },
          "The extended arm; None where an incomplete search names no cause.")
      .def_property_readonly(
          "is_complete",
          [](const Diagnosed& self) { return !self.diagnosis.search_end.has_value(); },
          "False where the time limit ended the search.")
      .def_property_readonly(
          "notices", [](const Diagnosed& self) { return self.diagnosis.notices; },
          "What was assumed or left out, a list of sentences.")
      .def_property_readonly("overlays", &overlays_of, "A list of Overlay, one a channel.")
      .def("figures", &figures_of,
           "The figures of `flexarm diagnose --out`: a dict of SVG texts by file name. Raises "
           "InputError where gnuplot is not installed.")
      .def(
          "to_json",
          [](const Diagnosed& self, const std::string& extended_arm) {
            return report::diagnosis_document(self.diagnosis, extended_arm);
          },
          py::arg("extended_arm") = "",
          "The text that `flexarm diagnose --json` writes (docs/json.md).\n\nArguments:\n"
          "  extended_arm: name of the file that holds the extended arm; '': null")
      .def(
          "write_json",
          [](const Diagnosed& self, const std::filesystem::path& path) {
            report::write_diagnosis(self.diagnosis, path);
          },
          py::arg("path"),
          "Writes the files of `flexarm diagnose --json PATH`: the JSON and, beside it, the "
          "extended arm. Raises InputError where they cannot be written.\n\nArguments:\n"
          "  path: that of the JSON file")
      .def("__repr__", [](const Diagnosed& self) {
        Texts causes;
        for (const auto& cause : self.diagnosis.causes) causes.push_back(cause.effect);
        return fmt::format("<flexarm.Diagnosis {}{}{}>", to_string(self.diagnosis.verdict),
                           causes.empty() ? "" : ": ", fmt::join(causes, ", "));
      });
  module.def("diagnose", &diagnose_measurement, py::arg("measurement"), py::kw_only(),
             py::arg("effects") = Texts{}, py::arg("exclude") = Texts{},
             py::arg("accept") = Texts{}, py::arg("time_limit_s") = py::none(),
             py::arg("max_causes") = py::none(), py::arg("predictor") = "auto",
             py::arg("policy") = std::map<std::string, double>{}, py::arg("progress") = py::none(),
             "Names the causes of the differences between the simulation of an arm and its "
             "measured data, as `flexarm diagnose` does: Diagnosis. Ctrl-C ends it.\n\n"
             "Arguments:\n"
             "  measurement: a Measurement, or the path of a measurement.toml\n"
             "  effects: names of the effects to test, a list ([]: all of the library)\n"
             "  exclude: effects that are not tested, 'NAME' or 'NAME on SENSOR', a list\n"
             "  accept: data checks whose faults count as none, a list of their names\n"
             "  time_limit_s: time after which the search ends [s] (None: no limit)\n"
             "  max_causes: most causes that are named together (None: as many as the data show)\n"
             "  predictor: how time runs are predicted, 'auto' or a name of docs/diagnosis.md "
             "('auto')\n"
             "  policy: numbers of the search that are not as documented, a dict\n"
             "  progress: a callable of the fraction done, None for a line on a terminal or in a "
             "notebook, False for none\n\n"
             "Raises InputError 'FILE:LINE: ...' for input that cannot be used, and for an "
             "argument, which its line begins with.");
  add_pickle<ParameterEstimate, Cause, RefittedNumber, Gain, RunOverlay, Symptom, Diagnosed>();
}

}  // namespace flexarm::python
