#pragma once

#include "arm/controller.hpp"
#include "arm/payload.hpp"
#include "measured/files/column_mapping.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What a run's file holds.
enum class RunKind {
  time,   ///< torque and sensors in time: measured/files/time_record.hpp
  frf,    ///< frequency responses
  modal,  ///< poles and zeros: measured/files/modal_table.hpp
};

/// What a run is for: to fit a model, or to test the fitted one.
enum class Purpose { estimation, validation };

/// The torque between its samples.
enum class TorqueHold {
  zero,   ///< constant from one sample to the next
  first,  ///< linear between samples
};

/// The arm at the first sample of a time run.
enum class InitialState { rest, free };

/// One run of an experiment.
struct Run {
  std::string id;
  RunKind kind = RunKind::time;
  std::string file;                     ///< relative to the measurement file
  std::optional<Purpose> purpose = {};  ///< empty: the program chooses
  TorqueHold torque_hold = TorqueHold::zero;
  std::optional<arm::Payload> payload = {};  ///< in place of the arm's own
  InitialState initial = InitialState::rest;
  ColumnMappings columns = {};       ///< of a time run whose file is a foreign log; otherwise empty
  bool torque_hold_is_known = true;  ///< false: the file of a time run does not say
  /// Of a time run in closed loop: the column with the reference, and what made the torque of it.
  /// Both or none. `reference` of a time record is its column "reference"; of a foreign log it has
  /// the unit and scale of the first sensor's column, unless it is given its own.
  std::optional<ColumnMapping> reference = {};
  std::optional<arm::Controller> controller = {};

  bool operator==(const Run&) const = default;
};

/// An experiment on one arm: measurement.toml (docs/formats.md).
struct Measurement {
  std::string name;
  std::string arm;  ///< arm file, relative to the measurement file; empty: none is stated
  std::vector<Run> runs;

  bool operator==(const Measurement&) const = default;
};

/// "time", "estimation", "zero", "rest": the words of the file.
std::string_view to_string(RunKind kind);
std::string_view to_string(Purpose purpose);
std::string_view to_string(TorqueHold hold);
std::string_view to_string(InitialState initial);

/// Reads a measurement file. The arm and the runs' files are not opened.
///
/// Throws InputError with one line `FILE:LINE: KEY = VALUE: what is wrong; what is allowed`: for a
/// file that cannot be read or is not TOML, an unknown key (with the name that was probably meant),
/// a value of the wrong type or out of its range, a missing key, no run, a run id given twice, and
/// `columns` that cannot be (`require_valid`) or stand in a run of another kind than `time`, and a
/// controller that cannot be (`arm::require_valid`), without a reference, or the other way round.
Measurement read_measurement(const std::filesystem::path& path);

/// The same for the text of a file; `file_name` stands in the errors.
Measurement parse_measurement(std::string_view toml, const std::string& file_name);

/// The measurement as the text of a file; `parse_measurement` reads the same one back.
/// Throws InputError for a text that is not UTF-8.
std::string format_measurement(const Measurement& measurement);

/// `format_measurement` written to `path`, whole or not at all (measured/files/atomic_file.hpp).
void write_measurement(const Measurement& measurement, const std::filesystem::path& path);

/// The line of `key`, "controller" or "controller.kp", of the run of that id in the measurement
/// file: of the key that holds it where it is not there, and 0 where that is not there either.
int line_of_run_key(const std::filesystem::path& measurement_file, const std::string& run_id,
                    const std::string& key);

/// The arm file of a measurement; throws InputError where it states none.
std::filesystem::path arm_file_of(const std::filesystem::path& measurement_file,
                                  const Measurement& measurement);

/// The measurement file, the arm's and the runs'.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& measurement_file,
                                            const Measurement& measurement);

/// Where a file that the measurement at `measurement_file` names is.
std::filesystem::path beside(const std::filesystem::path& measurement_file,
                             const std::string& file);

}  // namespace flexarm::measured
