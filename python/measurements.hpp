#pragma once

#include "compare/recording.hpp"

#include <filesystem>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::python {

/// Recordings of an experiment with their arm, which a measurement file names or Python gives.
struct Measurement {
  std::string name;
  std::optional<arm::Arm> arm;     ///< empty: that of the file, or not known yet
  std::filesystem::path arm_file;  ///< empty: none
  std::filesystem::path file;      ///< empty: not read from a measurement.toml
  std::vector<measured::MeasuredRun> runs;
  std::vector<std::string> notes = {};  ///< of an import, a sentence each
};

/// What identify and diagnose take: a measurement, or the path of its file.
using MeasurementSource = std::variant<Measurement, std::filesystem::path>;

/// Throws py::type_error, one line, for any other object.
MeasurementSource measurement_source(const pybind11::object& measurement);

/// Returns its arm, or that of its arm file; empty without one, or where no number is filled in in
/// the file. Throws arm::InputError as `measured::read_arm_file`.
std::optional<arm::Arm> known_arm(const Measurement& measurement);

/// The recording of a measurement, or that of the file. Throws arm::InputError as
/// `compare::read_recording`, and where the arm is not known.
compare::Recording recording_of(const MeasurementSource& source);

}  // namespace flexarm::python
