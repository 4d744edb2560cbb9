#include "python/measurements.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "python/archive.hpp"
#include "python/arm.hpp"
#include "python/measured_runs.hpp"
#include "python/module.hpp"

#include <fmt/format.h>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <utility>

namespace flexarm::python {

namespace py = pybind11;

namespace {

Measurement read_measurement(const std::filesystem::path& path) {
  const auto file = measured::read_measurement(path);
  Measurement measurement{
      file.name,
      {},
      file.arm.empty() ? std::filesystem::path() : measured::beside(path, file.arm),
      path,
      {}};
  for (const auto& run : file.runs) {
    measurement.runs.push_back({run, measured::read_run(path, run)});
  }
  return measurement;
}

std::vector<AnyRun> runs_in(const py::object& runs) {
  const bool is_one = py::isinstance<TimeRun>(runs) || py::isinstance<FrequencyRun>(runs) ||
                      py::isinstance<ModalRun>(runs);
  if (is_one) return {runs.cast<AnyRun>()};
  // A DataFrame passes for a sequence.
  if (!py::isinstance<py::list>(runs) && !py::isinstance<py::tuple>(runs)) throw py::cast_error();
  return runs.cast<std::vector<AnyRun>>();
}

Measurement measurement_of(const py::object& arm, const py::object& runs, const std::string& name) {
  Measurement made{name, {}, {}, {}, {}};
  if (!arm.is_none()) made.arm = arm_of(arm);
  try {
    for (const auto& run : runs_in(runs)) made.runs.push_back(as_measured(run));
  } catch (const py::cast_error&) {
    throw py::type_error("runs: must be a TimeRun, FrequencyRun or ModalRun, or a list of these");
  }
  compare::require_valid({name, made.arm.value_or(arm::Arm()), made.runs});
  return made;
}

arm::Arm arm_in(const Measurement& measurement) {
  if (const auto known = known_arm(measurement)) return *known;
  throw arm::InputError("measurement: has no arm; make it with Measurement(arm, runs)");
}

void write(const Measurement& measurement, const std::filesystem::path& folder) {
  const arm::Arm arm = arm_in(measurement);
  measured::Measurement file{measurement.name, "arm.toml", {}};
  std::vector<measured::NamedContent> contents;
  for (auto [run, data] : measurement.runs) {
    run.file = run.id + ".csv";
    run.columns.clear();  // they are of the log, not of what is written
    contents.push_back({run.file, measured::format_run_data(data)});
    file.runs.push_back(std::move(run));
  }
  contents.push_back({"arm.toml", measured::format_arm(arm)});
  contents.push_back({"measurement.toml", measured::format_measurement(file)});
  measured::write_folder_atomically(folder, contents, measured::IfExists::refuse);
}

}  // namespace

MeasurementSource measurement_source(const py::object& measurement) {
  if (py::isinstance<Measurement>(measurement)) return measurement.cast<Measurement>();
  try {
    return measurement.cast<std::filesystem::path>();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format(
        "measurement: {}; must be the path of a measurement.toml, or Measurement(arm, runs)",
        std::string(py::str(py::type::handle_of(measurement).attr("__name__")))));
  }
}

std::optional<arm::Arm> known_arm(const Measurement& measurement) {
  if (measurement.arm) return measurement.arm;
  const auto& file = measurement.arm_file;
  if (file.empty() || measured::is_unfilled_arm_file(file)) return std::nullopt;
  return measured::read_arm_file(file, effects::vocabulary());
}

compare::Recording recording_of(const MeasurementSource& source) {
  if (const auto* path = std::get_if<std::filesystem::path>(&source)) {
    return compare::read_recording(*path);
  }
  const auto& measurement = std::get<Measurement>(source);
  return {measurement.name, arm_in(measurement), measurement.runs};
}

void add_measurements(py::module_& module) {
  add_measured_runs(module);
  py::class_<Measurement>(
      module, "Measurement",
      "Recordings of an experiment on one arm, of a file or of numbers.\n\nArguments:\n"
      "  arm: an Arm, the path of an arm file, or None where it is not known\n"
      "  runs: a TimeRun, FrequencyRun or ModalRun, or a list of these, each with its own id\n"
      "  name: its name\n\n"
      "identify and diagnose take it as they take the path of a measurement.toml; identify needs "
      "no "
      "arm. Raises "
      "InputError for runs that do not go together.")
      .def(py::init(&measurement_of), py::arg("arm"), py::arg("runs"), py::arg("name") = "")
      .def_readonly("name", &Measurement::name, "Its name.")
      .def_property_readonly(
          "arm", &known_arm,
          "Its Arm, read from the arm file where there is one; None where it is not known, or no "
          "number is filled in in the file.")
      .def_property_readonly(
          "arm_file", [](const Measurement& self) { return self.arm_file.string(); },
          "Path of the arm file, '' without one.")
      .def_property_readonly(
          "runs",
          [](const Measurement& self) {
            std::vector<AnyRun> runs;
            for (const auto& run : self.runs) runs.push_back(as_given(run));
            return runs;
          },
          "The runs, a list of TimeRun, FrequencyRun and ModalRun.")
      .def_readonly("notes", &Measurement::notes,
                    "What an import assumed, left out and warned of, a list of sentences.")
      .def("write", &write, py::arg("folder"),
           "Writes a new folder: measurement.toml, arm.toml and a CSV file for each run, which "
           "read_measurement reads back. Raises InputError where the folder exists or the arm is "
           "not known.\n\nArguments:\n  folder: its path")
      .def("__repr__", [](const Measurement& self) {
        return fmt::format("<flexarm.Measurement '{}': {} runs>", self.name, self.runs.size());
      });
  module.def("read_measurement", &read_measurement, py::arg("path"),
             "Reads measurement.toml and the files of its runs, in SI units (docs/formats.md): "
             "Measurement. Raises InputError 'FILE:LINE: ...'.\n\nArguments:\n"
             "  path: that of the measurement.toml");
  add_pickle<Measurement>();
}

}  // namespace flexarm::python
