#include "arm/input_error.hpp"
#include "importing/import_request.hpp"
#include "python/argument_names.hpp"
#include "python/arm.hpp"
#include "python/long_call.hpp"
#include "python/measurements.hpp"
#include "python/module.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using Texts = std::vector<std::string>;

/// One text, several, or a dict of "QUANTITY": "NAME:UNIT:SCALE".
Texts texts_in(const py::object& given) {
  if (py::isinstance<py::str>(given)) return {given.cast<std::string>()};
  Texts texts;
  if (py::isinstance<py::dict>(given)) {
    for (const auto& [key, value] : given.cast<py::dict>()) {
      texts.push_back(fmt::format("{}={}", key.cast<std::string>(), value.cast<std::string>()));
    }
    return texts;
  }
  for (const auto& one : given) {
    texts.push_back(py::str(one));  // of files, paths too
  }
  return texts;
}

/// The line of the program with its options as arguments: "sample_time_s" for "--period".
std::string with_arguments(const std::string& line) {
  static const std::regex option("--([a-z]+(-[a-z]+)*)");
  std::string text;
  auto end = line.cbegin();
  for (std::sregex_iterator found(line.begin(), line.end(), option);
       found != std::sregex_iterator(); ++found) {
    text.append(end, (*found)[0].first);
    text += as_argument((*found)[1].str());
    end = (*found)[0].second;
  }
  return text.append(end, line.cend());
}

/// What the program prints of its files and runs.
Texts notes_of(const importing::Import& made, Texts& warnings) {
  Texts notes;
  for (const auto& file : made.files) {
    const std::string name = arm::shown(file.file) + ": ";
    for (const auto& sentence : file.warnings) {
      warnings.push_back(name + with_arguments(sentence));
      notes.push_back(warnings.back());
    }
    for (const auto& sentence : file.assumptions) notes.push_back(name + with_arguments(sentence));
    for (const auto& column : file.not_used) notes.push_back(name + "not used: " + column);
  }
  for (const auto& run : made.runs) {
    for (const auto& sentence : run.notes) {
      notes.push_back(fmt::format("run {}: {}", run.run.id, with_arguments(sentence)));
    }
  }
  return notes;
}

Measurement import_log(const py::object& path, const py::object& arm, const std::string& name,
                       const py::object& column, const py::object& compute,
                       const std::string& torque, const std::string& time_unit,
                       const std::string& reference, const py::object& own_rate,
                       const py::object& leave_out, const std::string& controller, bool join,
                       const std::string& join_grid, const std::string& kind,
                       std::optional<double> sample_time_s, std::optional<std::size_t> raw_columns,
                       const std::string& id, const std::string& rows, const std::string& times,
                       const py::object& runs, std::optional<int> decimate,
                       const std::string& clock, int fill_gaps, const std::string& purpose,
                       const py::object& validation, const std::string& hold,
                       const std::string& initial, std::optional<double> payload_mass_kg,
                       std::optional<double> payload_inertia_kg_m2, const py::object& progress) {
  const bool is_one = py::isinstance<py::str>(path) || py::hasattr(path, "__fspath__");
  importing::ImportRequest request;
  request.files = is_one ? Texts{path.cast<std::filesystem::path>().string()} : texts_in(path);
  request.file = {.kind = {},
                  .columns = {.typed = texts_in(column),
                              .computed = texts_in(compute),
                              .torque = torque,
                              .time_unit = time_unit,
                              .reference = reference,
                              .left_out = texts_in(leave_out),
                              .own_rate = texts_in(own_rate)},
                  .controller = {},
                  .period_s = sample_time_s,
                  .raw_columns = raw_columns};
  request.join = {join, join_grid};
  request.kind = kind;
  request.controller = controller;
  request.runs = {.id = id,
                  .rows = rows,
                  .times = times,
                  .runs = texts_in(runs),
                  .decimation = decimate,
                  .clock = clock,
                  .longest_filled_gap = fill_gaps,
                  .hold = hold,
                  .initial = initial,
                  .purpose = purpose,
                  .validation = texts_in(validation),
                  .payload_mass_kg = payload_mass_kg,
                  .payload_inertia_kg_m2 = payload_inertia_kg_m2,
                  .controller = {}};
  if (request.files.empty()) throw arm::InputError("path: none; needs one file or more");
  Measurement measurement{name, {}, {}, {}, {}};
  if (!arm.is_none()) measurement.arm = arm_of(arm);
  try {
    const auto made = long_call("import", progress, [&](CallState& state) {
      double done = 0.0;
      return importing::import_logs(
          request, [&] { state.reach(++done / static_cast<double>(request.files.size())); });
    });
    for (const auto& run : made.runs) measurement.runs.push_back({run.run, run.data});
    if (name.empty() && made.runs.size() == 1) measurement.name = made.runs.front().run.id;
    Texts warnings;
    measurement.notes = notes_of(made, warnings);
    for (const auto& warning : warnings) {
      if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
    }
  } catch (const arm::InputError& error) {
    throw arm::InputError(with_arguments(error.what()));
  }
  return measurement;
}

constexpr const char* kText =
    "Converts log files (text, universal file, MATLAB, JSON, doubles) to a Measurement, as "
    "`flexarm import` does; its `notes` have what was assumed, and warnings are Python's.\n\n"
    "Arguments, as the options of the command:\n"
    "  path: that of the log, or a list of paths\n"
    "  arm: an Arm or the path of an arm file (None: not known)\n"
    "  name: name of the measurement ('': that of its only run)\n"
    "  column: 'QUANTITY=NAME:UNIT:SCALE', a list of these, or a dict {'torque': 'NAME:UNIT'}\n"
    "  compute: 'QUANTITY [UNIT]=EXPRESSION' of columns, or a list of these\n"
    "  torque: expression for the torque [N m]\n"
    "  time_unit: unit of the time column: 's', 'ms', ... ('': that of the file)\n"
    "  reference: 'NAME:UNIT:SCALE', the column with the reference of the controller\n"
    "  own_rate: 'QUANTITY=hold', linear or rows, of a column written at its own rate\n"
    "  leave_out: name of a column that is not imported, or a list of these\n"
    "  controller: 'KEY=VALUE,...' or the path of its file ('': open loop)\n"
    "  join: the files are one run, with some of its signals each\n"
    "  join_grid: times of the joined run: 'same', 'first' or 'coarsest'\n"
    "  kind: content, 'time', 'frf' or 'modal' ('': detected)\n"
    "  sample_time_s: sampling period [s] of a file without times\n"
    "  raw_columns: columns of a file of doubles (None: no such file)\n"
    "  id: id of the run ('': the file's name)\n"
    "  rows: 'FROM:TO', rows from 1 ('': all)\n"
    "  times: 'FROM:TO', times [s] ('': all)\n"
    "  runs: 'ID=FROM:TO' [s] or 'ID=rows:FROM:TO', ranges that become runs, or a list of these\n"
    "  decimate: every so many samples one, after a low-pass (None: all)\n"
    "  clock: uneven times are 'stamped' (resampled) or 'even' (late stamps)\n"
    "  fill_gaps: longest gap [samples] that is filled\n"
    "  purpose: of the runs, 'estimation' or 'validation' ('': the program chooses)\n"
    "  validation: id of a run for validation, or a list of these\n"
    "  hold: torque between samples, 'zero' or 'first' ('': zero, first after decimate)\n"
    "  initial: state at the first sample, 'rest' or 'free' ('': by the range)\n"
    "  payload_mass_kg: mass of the payload of the runs [kg] (None: that of the arm)\n"
    "  payload_inertia_kg_m2: its inertia about its centre of mass [kg m^2]\n"
    "  progress: as in simulate\n\n"
    "Raises InputError, with the line of the command.";

}  // namespace

void add_importing(py::module_& module) {
  const py::tuple none(0);
  module.def("import_log", &import_log, py::arg("path"), py::kw_only(), py::arg("arm") = py::none(),
             py::arg("name") = "", py::arg("column") = none, py::arg("compute") = none,
             py::arg("torque") = "", py::arg("time_unit") = "", py::arg("reference") = "",
             py::arg("own_rate") = none, py::arg("leave_out") = none, py::arg("controller") = "",
             py::arg("join") = false, py::arg("join_grid") = importing::JoinChoice{}.grid,
             py::arg("kind") = "", py::arg("sample_time_s") = py::none(),
             py::arg("raw_columns") = py::none(), py::arg("id") = "", py::arg("rows") = "",
             py::arg("times") = "", py::arg("runs") = none, py::arg("decimate") = py::none(),
             py::arg("clock") = importing::RunsChoice{}.clock,
             py::arg("fill_gaps") = importing::RunsChoice{}.longest_filled_gap,
             py::arg("purpose") = "", py::arg("validation") = none, py::arg("hold") = "",
             py::arg("initial") = "", py::arg("payload_mass_kg") = py::none(),
             py::arg("payload_inertia_kg_m2") = py::none(), py::arg("progress") = py::none(),
             kText);
}

}  // namespace flexarm::python
