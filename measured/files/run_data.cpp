#include "measured/files/run_data.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_expression.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/foreign_table.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace flexarm::measured {

namespace {

using arm::InputError;

TimeRecord read_log(const std::filesystem::path& file, const Run& run) {
  const ForeignTable table = read_foreign_table(file);
  const std::string file_name = arm::shown(file.string());
  TimeRecord record = time_record_of(table, run.columns, file_name);
  if (!run.reference) return record;
  const ColumnMapping& reference = *run.reference;
  try {
    if (reference.expression.empty()) {
      find_column(table, reference.name);
    } else {
      columns_in(reference.expression, column_names(table.columns));
    }
  } catch (const InputError& error) {
    throw InputError(
        reference.expression.empty()
            ? fmt::format("reference = \"{}\": {}", arm::shown(reference.name), error.what())
            : fmt::format("reference.{}", error.what()),
        "reference");
  }
  // It is read as the sensor that the controller reads first.
  record.reference =
      reference_of(table, reference, run.controller->sensors.front(), record.time_s, file_name);
  return record;
}

/// Throws InputError, with the key in the run, for a record that the run's loop does not fit.
void require_loop_fits(const TimeRecord& record, const Run& run, const std::string& file_name) {
  if (record.reference.values.empty()) {
    throw InputError(fmt::format("reference = \"{}\": no column {} [UNIT] in {}",
                                 run.reference->name, kReferenceColumn, file_name),
                     "reference");
  }
  const arm::Controller& controller = *run.controller;
  const arm::Sensor& sensor = controller.sensors.front();
  if (std::holds_alternative<arm::PidController>(controller.law) &&
      record.reference.unit != arm::unit(sensor)) {
    throw InputError(fmt::format("reference = \"{}\": in {} in {}; must be in {}, the unit of {}",
                                 run.reference->name, record.reference.unit, file_name,
                                 arm::unit(sensor), arm::to_string(sensor)),
                     "reference");
  }
  try {
    arm::samples_per_period(controller, sampling_period_s(record));
  } catch (const InputError& error) {
    throw InputError(fmt::format("controller.{} ({})", error.what(), file_name),
                     "controller.sample_time");
  }
}

/// The kind of a run that has such data.
RunKind run_kind_of(const RunData& data) {
  if (std::holds_alternative<TimeRecord>(data)) return RunKind::time;
  return std::holds_alternative<FrequencyRecord>(data) ? RunKind::frf : RunKind::modal;
}

}  // namespace

void require_valid(const Run& run, const RunData& data) {
  const std::string place = "run " + arm::shown(run.id);
  try {
    if (run.kind != run_kind_of(data)) {
      throw InputError(fmt::format("kind = \"{}\": its data are of kind {}", to_string(run.kind),
                                   to_string(run_kind_of(data))));
    }
    if (const auto* record = std::get_if<TimeRecord>(&data)) {
      require_valid(*record);
      if (run.controller) require_loop_fits(*record, run, "the run");
    } else if (const auto* responses = std::get_if<FrequencyRecord>(&data)) {
      require_valid(*responses);
    } else {
      require_valid(std::get<ModalTable>(data));
    }
  } catch (const InputError& error) {
    throw arm::located(error, place, 0);
  }
}

std::string format_run_data(const RunData& data) {
  if (const auto* time = std::get_if<TimeRecord>(&data)) return format_time_record(*time);
  if (const auto* responses = std::get_if<FrequencyRecord>(&data)) {
    return format_frequency_record(*responses);
  }
  return format_modal_table(std::get<ModalTable>(data));
}

RunData read_run(const std::filesystem::path& measurement_file, const Run& run) {
  const std::filesystem::path file = beside(measurement_file, run.file);
  switch (run.kind) {
    case RunKind::time:
      try {
        TimeRecord record = run.columns.empty() ? read_time_record(file) : read_log(file, run);
        if (run.controller) require_loop_fits(record, run, arm::shown(file.string()));
        return record;
      } catch (const InputError& error) {
        if (error.key().empty()) throw;  // about the run's own file
        throw arm::located(InputError(fmt::format("run.{}", error.what())),
                           arm::shown(measurement_file.string()),
                           line_of_run_key(measurement_file, run.id, error.key()));
      }
    case RunKind::frf:
      return read_frequency_record(file);
    case RunKind::modal:
      return read_modal_table(file);
  }
  throw std::invalid_argument("a run of no kind");
}

}  // namespace flexarm::measured
