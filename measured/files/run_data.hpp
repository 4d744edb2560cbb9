#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/modal_table.hpp"
#include "measured/files/time_record.hpp"

#include <filesystem>
#include <variant>

namespace flexarm::measured {

/// What a run measured, by its kind: `time`, `frf`, `modal`.
using RunData = std::variant<TimeRecord, FrequencyRecord, ModalTable>;

/// Reads the file of a run of the measurement file, in SI units; a time run that has `columns` is a
/// foreign log (measured/files/foreign_table.hpp), any other is the CSV of its kind.
///
/// Throws InputError `FILE:LINE: ...` where the reader of that file does.
RunData read_run(const std::filesystem::path& measurement_file, const Run& run);

/// The data as the text of a file of their kind (CSV); `read_run` reads the same data back.
std::string format_run_data(const RunData& data);

/// Throws InputError, with "run ID: " in front, for data in memory that no file of the run could
/// hold: as `require_valid` of the record, for data of another kind than the run's, and for a loop
/// that does not fit them.
void require_valid(const Run& run, const RunData& data);

/// A run of an experiment with what its file holds.
struct MeasuredRun {
  Run run;
  RunData data;
};

}  // namespace flexarm::measured
