#include "compare/identification.hpp"

#include "arm/input_error.hpp"
#include "compare/identification_task.hpp"
#include "measured/files/atomic_file.hpp"
#include "python/archive.hpp"
#include "python/argument_names.hpp"
#include "python/arrays.hpp"
#include "python/long_call.hpp"
#include "python/measurements.hpp"
#include "python/module.hpp"
#include "python/records.hpp"
#include "report/json/identification_json.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/method_differences.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <pybind11/complex.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using Texts = std::vector<std::string>;

/// An identification with what it is of.
struct Identified {
  std::string name;
  std::optional<arm::Arm> arm;
  measured::Identification identification;
  std::vector<compare::IdentifiedCondition> conditions;
};

/// A measured root with where it comes from.
struct Root {
  compare::IdentifiedRoot root;
  std::string method;
  Texts runs;
  std::optional<arm::Sensor> sensor;
  double payload_mass_kg;
  bool hub_held;
};

std::vector<Root> roots_of(const Identified& self, const std::optional<std::string>& feature,
                           const std::optional<std::string>& method,
                           const std::optional<std::string>& sensor) {
  std::vector<Root> roots;
  for (const auto& condition : self.conditions) {
    for (std::size_t i = 0; i < condition.readings.size(); ++i) {
      const auto& reading = self.identification.readings[condition.readings[i]];
      for (const auto& root : condition.roots[i]) {
        Root made{root,
                  std::string(to_string(reading.method)),
                  reading.runs,
                  root.measured.sensor ? root.measured.sensor : reading.sensor,
                  condition.payload.mass_kg,
                  reading.hub_held};
        if (feature && *feature != to_string(root.measured.feature)) continue;
        if (method && *method != made.method) continue;
        if (sensor && made.sensor != arm::parse_sensor(*sensor)) continue;
        roots.push_back(std::move(made));
      }
    }
  }
  return roots;
}

Identified identify(const py::object& measurement, const Texts& runs, const Texts& sensors,
                    const std::string& window, std::optional<double> resolution_Hz,
                    std::optional<double> overlap_percent, const std::string& detrend,
                    const std::string& peaks, const std::string& input,
                    std::optional<double> from_Hz, std::optional<double> to_Hz,
                    std::optional<int> modes, int highest_order,
                    std::optional<double> total_inertia_kg_m2, bool fit,
                    const py::object& progress) {
  const compare::IdentificationRequest request{
      .runs = runs,
      .sensors = sensors,
      .spectrum = {window, resolution_Hz, overlap_percent, detrend, peaks},
      .input = input,
      .fit = fit,
      .modes = modes,
      .from_Hz = from_Hz,
      .to_Hz = to_Hz,
      .highest_order = highest_order,
      .total_inertia_kg_m2 = total_inertia_kg_m2,
      .spelled = as_argument};
  const MeasurementSource source = measurement_source(measurement);
  return long_call("identification", progress, [&](CallState& state) {
    const auto* given = std::get_if<Measurement>(&source);
    auto task =
        given ? compare::identification_task(given->name, known_arm(*given), given->runs, request)
              : compare::read_identification_task(std::get<std::filesystem::path>(source), request);
    task.options.progress = [&](std::string_view, double fraction) {
      return state.reach(fraction);
    };
    Identified identified{task.measurement.name, task.arm, {}, {}};
    identified.identification = measured::identify(std::move(task.runs), task.options);
    if (state.reach(1.0)) {
      identified.conditions = compare::conditions_of(identified.identification, task.arm);
    }
    return identified;
  });
}

void add_root(py::module_& module) {
  const auto number = [](auto member) {
    return [member](const Root& self) { return self.root.measured.*member; };
  };
  using measured::ModalEntry;
  py::class_<Root>(module, "IdentifiedRoot",
                   "An estimated pole or zero beside that of the arm file; None: not known.")
      .def_property_readonly(
          "feature",
          [](const Root& self) { return std::string(to_string(self.root.measured.feature)); },
          "'pole' or 'zero'.")
      .def_readonly("method", &Root::method,
                    "'fit' (rational fit), 'circle', 'response', 'autopower' or 'table'.")
      .def_readonly("runs", &Root::runs, "Ids of the runs, a list.")
      .def_property_readonly(
          "sensor",
          [](const Root& self) {
            return self.sensor ? std::optional(arm::to_string(*self.sensor)) : std::nullopt;
          },
          "Name of the sensor; None: of all at once.")
      .def_readonly("payload_mass_kg", &Root::payload_mass_kg, "Mass of the payload [kg].")
      .def_readonly("hub_held", &Root::hub_held, "From responses to the hub motion.")
      .def_property_readonly(
          "order", [](const Root& self) { return self.root.order; },
          "From 1, of the root of the arm file; counted up without an arm.")
      .def_property_readonly(
          "alias_of_Hz", [](const Root& self) { return self.root.alias_of_Hz; },
          "Of the alias of a mode above the Nyquist frequency: that mode's frequency [Hz].")
      .def_property_readonly("frequency_Hz", number(&ModalEntry::frequency_Hz), "|s|/(2 pi) [Hz].")
      .def_property_readonly("frequency_std_Hz", number(&ModalEntry::frequency_std_Hz),
                             "Its standard error [Hz].")
      .def_property_readonly("damping_ratio", number(&ModalEntry::damping_ratio),
                             "Damping ratio [1].")
      .def_property_readonly("damping_ratio_std", number(&ModalEntry::damping_ratio_std),
                             "Its standard error [1].")
      .def_property_readonly(
          "analytical_Hz", [](const Root& self) { return self.root.analytical_Hz; },
          "That of the arm file [Hz].")
      .def_property_readonly(
          "analytical_damping_ratio",
          [](const Root& self) { return self.root.analytical_damping_ratio; },
          "That of the arm file [1].")
      .def_property_readonly(
          "error_percent", [](const Root& self) { return self.root.error_percent(); },
          "100 (measured - analytical)/analytical; NaN where either is unknown.")
      .def("__repr__", [](const Root& self) {
        const auto& measured = self.root.measured;
        return fmt::format("<flexarm.IdentifiedRoot {} {}: {:.6g} +- {:.2g} Hz, by {}>",
                           to_string(measured.feature),
                           self.root.order ? fmt::to_string(*self.root.order) : "?",
                           measured.frequency_Hz.value_or(0.0),
                           measured.frequency_std_Hz.value_or(0.0), self.method);
      });
}

}  // namespace

void add_identification(py::module_& module) {
  add_root(module);
  py::class_<Identified>(module, "Identification",
                         "Spectra, poles, zeros, damping and gains estimated from a measurement.")
      .def_readonly("name", &Identified::name, "Name of the measurement.")
      .def_readonly("arm", &Identified::arm, "The arm of its file; None without one.")
      .def("roots", &roots_of, py::kw_only(), py::arg("feature") = py::none(),
           py::arg("method") = py::none(), py::arg("sensor") = py::none(),
           "The roots of all methods, or some of them: a list of IdentifiedRoot.\n\nArguments:\n"
           "  feature: 'pole' or 'zero'; None: both\n"
           "  method: 'fit', 'circle', 'response', 'autopower' or 'table'; None: all\n"
           "  sensor: its name; None: all")
      .def_property_readonly(
          "poles", [](const Identified& self) { return roots_of(self, "pole", "fit", {}); },
          "Poles of the rational fits, a list of IdentifiedRoot.")
      .def_property_readonly(
          "zeros", [](const Identified& self) { return roots_of(self, "zero", "fit", {}); },
          "Zeros of the rational fits, a list of IdentifiedRoot.")
      .def_property_readonly(
          "doubts", [](const Identified& self) { return report::doubts(self.identification); },
          "Why fits are not to be relied on: not converged, or unphysical; a list of sentences.")
      .def_property_readonly(
          "differences",
          [](const Identified& self) {
            return report::all_method_differences(self.identification, self.conditions);
          },
          "Poles that methods do not agree on by their errors, a list of sentences.")
      .def_property_readonly(
          "notes", [](const Identified& self) { return report::data_notes(self.identification); },
          "What was found about the data, a list of sentences.")
      .def(
          "to_json",
          [](const Identified& self) {
            return report::identification_document(self.name, self.arm, self.identification,
                                                   self.conditions);
          },
          "The text that `flexarm identify --json` writes (docs/json.md).")
      .def("__repr__", [](const Identified& self) {
        return fmt::format("<flexarm.Identification of '{}': {} poles, {} zeros by fits>",
                           self.name, roots_of(self, "pole", "fit", {}).size(),
                           roots_of(self, "zero", "fit", {}).size());
      });
  module.def(
      "identify", &identify, py::arg("measurement"), py::kw_only(), py::arg("runs") = Texts{},
      py::arg("sensors") = Texts{}, py::arg("window") = "", py::arg("resolution_Hz") = py::none(),
      py::arg("overlap_percent") = py::none(), py::arg("detrend") = "",
      py::arg("peaks") = "between", py::arg("input") = "", py::arg("from_Hz") = py::none(),
      py::arg("to_Hz") = py::none(), py::arg("modes") = py::none(),
      py::arg("highest_order") = measured::ModalFitOptions{}.highest_order,
      py::arg("total_inertia_kg_m2") = py::none(), py::arg("fit") = true,
      py::arg("progress") = py::none(),
      "Estimates poles, zeros, damping and gains of measured data, as `flexarm identify` does; "
      "what is not given is chosen from the data: Identification. Ctrl-C ends it.\n\n"
      "Arguments:\n"
      "  measurement: a Measurement, or the path of a measurement.toml\n"
      "  runs: ids of the runs, a list ([]: all)\n"
      "  sensors: names of the sensors, a list ([]: all)\n"
      "  window: of the spectra, 'hann', 'rectangular', ... ('': by the torque)\n"
      "  resolution_Hz: of the spectra [Hz]\n"
      "  overlap_percent: of their segments [%], below 100\n"
      "  detrend: 'none', 'mean' or 'line'\n"
      "  peaks: where peaks are read, 'between' or 'on-line'\n"
      "  input: of the responses, 'torque', 'hub_angle' or 'hub_velocity' ('': by evidence)\n"
      "  from_Hz: lowest frequency of the fit [Hz] (None: 0, with to_Hz)\n"
      "  to_Hz: highest frequency of the fit [Hz] (None: by the data)\n"
      "  modes: flexible modes of the fit (None: by the data)\n"
      "  highest_order: of the stabilisation diagram, 2 to 100\n"
      "  total_inertia_kg_m2: I_T that the fit is held to [kg m^2] (None: fitted)\n"
      "  fit: whether a rational function is fitted\n"
      "  progress: as in simulate\n\n"
      "Raises InputError 'FILE:LINE: ...' for input that cannot be used, and for an argument, "
      "which its line begins with.");
  add_pickle<Root, Identified>();
}

}  // namespace flexarm::python
