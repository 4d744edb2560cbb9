#include "importing/imported_file.hpp"

#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "importing/imported_responses.hpp"
#include "importing/running_times.hpp"
#include "importing/unit_contradictions.hpp"
#include "measured/checks/time_unit_check.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/complete_rows.hpp"
#include "measured/files/raw_doubles.hpp"
#include "measured/files/time_grid.hpp"
#include "measured/files/universal_grid.hpp"
#include "measured/files/wrapped_angle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <utility>

namespace flexarm::importing {

namespace {

using arm::InputError;
using measured::ColumnLabel;
using measured::ForeignFile;
using measured::ForeignTable;
using measured::RunKind;

bool has_columns(const ForeignTable& table, std::initializer_list<const char*> names) {
  return std::ranges::all_of(names, [&](const char* name) {
    return std::ranges::count(table.columns, name, &measured::ForeignColumn::name) > 0;
  });
}

/// The columns of a modal table and of a frequency record of this program, row by row.
bool is_modal_form(const ForeignTable& table) {
  return has_columns(table, {"sensor", "feature"});
}
bool is_record_form(const ForeignTable& table) {
  return has_columns(table, {"sensor", "re"});
}

/// What the file holds; more than one only beside each other in a universal or MATLAB file.
std::vector<RunKind> kinds_of(const ForeignFile& file) {
  if (file.format == measured::ForeignFormat::text) {
    if (is_modal_form(file.table)) return {RunKind::modal};
    return {is_record_form(file.table) || !file.responses.empty() ? RunKind::frf : RunKind::time};
  }
  std::vector<RunKind> kinds;
  if (!file.responses.empty()) kinds.push_back(RunKind::frf);
  // A vector of frequencies alone is no signal in time, nor are the columns of responses.
  const auto columns = file.table.columns.size();
  std::size_t of_responses = 1;
  for (const auto& response : file.responses) of_responses += response.columns.size();
  if (columns > 0 && (kinds.empty() || columns > of_responses)) kinds.push_back(RunKind::time);
  if (!file.modes.empty()) kinds.push_back(RunKind::modal);
  return kinds;
}

const char* content_of(RunKind kind) {
  if (kind == RunKind::time) return "time signals";
  return kind == RunKind::frf ? "frequency responses" : "a modal table";
}

RunKind kind_of(const ForeignFile& file, std::optional<RunKind> given) {
  const auto kinds = kinds_of(file);
  if (!given && kinds.size() == 1) return kinds.front();
  if (!given) {
    std::vector<std::string> contents;
    std::vector<std::string> options;
    for (const auto kind : kinds) {
      contents.emplace_back(content_of(kind));
      options.push_back(fmt::format("--kind {}", to_string(kind)));
    }
    throw InputError(fmt::format("contains {}; choose with {}", fmt::join(contents, " and "),
                                 fmt::join(options, " or ")));
  }
  const bool is_table = file.format == measured::ForeignFormat::text && *given == RunKind::time;
  if (is_table || std::ranges::count(kinds, *given) > 0) return *given;
  if (*given == RunKind::frf && !file.table.columns.empty()) {
    throw InputError(fmt::format(
        "--kind frf: {}; state the parts with --column frequency=NAME:Hz, --column "
        "hub_angle.magnitude=NAME:dB and --column hub_angle.phase=NAME:deg, or hub_angle.real and "
        "hub_angle.imaginary",
        file.incomplete_response.empty() ? "no columns of a frequency response are recognised"
                                         : file.incomplete_response));
  }
  throw InputError(
      fmt::format("--kind {}: the file contains {}", to_string(*given), content_of(kinds.front())));
}

/// A table with texts in it as CSV, each row on the line that it has in the file.
std::string csv_of(const ForeignTable& table) {
  std::string out;
  int line = 1;
  for (; line + 1 < table.line_of_row.front(); ++line) out += '\n';
  out += fmt::format("{}\n", fmt::join(measured::column_names(table.columns), ","));
  ++line;
  for (std::size_t row = 0; row < table.line_of_row.size(); ++row) {
    for (; line < table.line_of_row[row]; ++line) out += '\n';
    std::vector<std::string> cells;
    for (const auto& column : table.columns) {
      if (column.is_text()) {
        cells.push_back(fmt::format("\"{}\"", column.texts[row]));
      } else {
        const double value = column.values[row];
        cells.push_back(std::isnan(value) ? "" : fmt::format("{}", value));
      }
    }
    out += fmt::format("{}\n", fmt::join(cells, ","));
    ++line;
  }
  return out;
}

/// "; Strom (A) may be a motor current; state it with ...", of the columns that may be it.
std::string asked(const measured::ColumnGuess& guess, bool torque_alone) {
  std::string text;
  for (const auto& question : guess.questions) {
    if (question.may_be_torque == torque_alone) text += "; " + question.sentence;
  }
  return text;
}

/// "; not read: ts: an object of ...", of what stands in the file besides.
std::string besides(const std::vector<std::string>& left_out) {
  if (left_out.empty()) return "";
  return "; not read: " + arm::shown(fmt::format("{}", fmt::join(left_out, "; ")), 400);
}

/// "; hub_angle = #FOO in line 3: ...", of columns that one sign keeps from being numbers.
std::string strays(const ForeignTable& table) {
  const auto sentences = measured::stray_texts(table);
  return sentences.empty() ? "" : fmt::format("; {}", fmt::join(sentences, "; "));
}

/// " (log{1} increases evenly, as a time does)", of the only column that does.
std::string likely_time(const ForeignTable& table) {
  std::vector<std::string> found;
  for (const auto& column : table.columns) {
    constexpr std::size_t kFewest = 3;
    const bool is_even =
        column.values.size() >= kFewest &&
        std::ranges::all_of(column.values, [](double t) { return std::isfinite(t); }) &&
        !measured::grid_fault(column.values);
    if (is_even) found.push_back(column.name);
  }
  return found.size() == 1
             ? fmt::format(" ({} increases evenly, as a time does)", arm::shown(found.front()))
             : "";
}

void require_told(const measured::ColumnGuess& guess, const std::vector<ColumnLabel>& labels,
                  const ForeignFile& file, bool is_one_of_several) {
  const std::string join = is_one_of_several ? "; if the files are of one run, add --join" : "";
  const measured::ColumnMappings& mappings = guess.mappings;
  for (const auto& [quantity, otherwise] :
       {std::pair{"time", ", or the sampling period with --period"},
        std::pair{"torque",
                  ", compute it with --torque EXPRESSION, or state a free decay with "
                  "--torque 0 --initial free"}}) {
    if (mappings.contains(quantity)) continue;
    if (const auto several = guess.ambiguous.find(quantity); several != guess.ambiguous.end()) {
      throw InputError(
          fmt::format("{0}: {1}? Choose one with --column {0}=NAME", quantity,
                      arm::shown(fmt::format("{}", fmt::join(several->second, " or ")), 400)));
    }
    const bool is_time = quantity == std::string_view("time");
    throw InputError(fmt::format(
        "{0}: column not recognised; columns: {1}{2}; assign one with --column "
        "{0}=NAME:UNIT:SCALE{3}{4}{5}{6}{7}{8}",
        quantity, measured::shown_names(measured::column_names(labels)),
        is_time ? likely_time(file.table) : "", otherwise,
        quantity == std::string_view("torque") ? asked(guess, true) : "", besides(file.left_out),
        file.incomplete_response.empty() ? ""
                                         : "; no frequency response: " + file.incomplete_response,
        strays(file.table), join));
  }
  const bool has_sensor = std::ranges::any_of(
      mappings, [](const auto& entry) { return measured::sensor_of(entry.first).has_value(); });
  if (has_sensor) return;
  for (const auto& [quantity, names] : guess.ambiguous) {
    throw InputError(
        fmt::format("no column is a sensor; {0}: {1}? Choose one with --column {0}=NAME", quantity,
                    arm::shown(fmt::format("{}", fmt::join(names, " or ")), 400)));
  }
  throw InputError(
      fmt::format("no column is a sensor; columns: {}; assign one with --column "
                  "hub_angle=NAME:UNIT:SCALE{}{}{}{}",
                  measured::shown_names(measured::column_names(labels)), asked(guess, false),
                  besides(file.left_out), strays(file.table), join));
}

void read_text_kind(const ForeignFile& file, ImportedFile& imported) {
  const std::string csv = csv_of(file.table);
  const std::string name = arm::shown(imported.file);
  if (imported.kind == RunKind::modal) {
    imported.data = measured::parse_modal_table(csv, name);
  } else {
    measured::FrequencyRecord record = measured::parse_frequency_record(csv, name);
    for (const auto& channel : record.channels) {
      std::ranges::move(doubtful_parts(channel.response, arm::to_string(channel.sensor)),
                        std::back_inserter(imported.warnings));
    }
    imported.data = std::move(record);
  }
}

/// "time: ... speaks for ms".
void doubt_time(const FileChoice& choice, ImportedFile& imported) {
  const auto* record = std::get_if<measured::TimeRecord>(&imported.data);
  const auto time = imported.columns.find("time");
  if (record == nullptr || time == imported.columns.end() || choice.period_s ||
      !choice.columns.time_unit.empty()) {
    return;
  }
  const auto doubt = measured::doubt_time_unit(*record);
  if (!doubt) return;
  constexpr std::array<std::pair<const char*, double>, 4> kUnits = {
      {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  const auto used = std::ranges::find(
      kUnits, time->second.unit, [](const auto& unit) { return std::string_view(unit.first); });
  std::string remedy = "if it is in another unit, say so with --time-unit";
  for (const auto& [unit, seconds] : kUnits) {
    if (used == kUnits.end()) break;
    if (std::abs(seconds / (used->second * doubt->factor) - 1.0) > 0.5) continue;
    remedy = fmt::format("this speaks for {0}; if so, add --time-unit {0}", unit);
  }
  imported.warnings.push_back(
      fmt::format("time is read in {}, but {}; {}", time->second.unit, doubt->evidence, remedy));
}

/// Each sensor that the controller reads and no column is.
void warn_of_unrecorded(const arm::Controller& controller, ImportedFile& imported) {
  for (const arm::Sensor& sensor : controller.sensors) {
    const std::string name = arm::to_string(sensor);
    if (imported.columns.contains(name)) continue;
    imported.warnings.push_back(fmt::format(
        "the controller reads {0}, which is no column; the loop cannot be simulated with these "
        "data, but with the recorded torque; assign a column with --column {0}=NAME:UNIT:SCALE",
        name));
  }
}

bool is_unused(const std::string& column, const ImportedFile& imported) {
  return std::ranges::count(imported.not_used, column) > 0;
}

/// Leaves out the rows with empty cells; they are missing samples.
void leave_out_incomplete(ForeignTable& table, const FileChoice& choice, ImportedFile& imported) {
  const auto time = imported.columns.find("time");
  const bool has_times = time != imported.columns.end() && time->second.expression.empty();
  std::optional<double> start;
  if (has_times) {
    const auto& times = table.columns[measured::find_column(table, time->second.name)].values;
    if (!times.empty() && !std::isnan(times.front())) start = times.front();
  }
  auto kept = measured::keep_complete_rows(
      table, imported.columns, imported.reference ? &imported.reference->mapping : nullptr,
      choice.columns.own_rates());
  const auto seconds = [&](double told) {
    const auto unit = measured::unit_of("time", time->second.unit).value_or(measured::Unit{});
    return unit.to_si(told * time->second.scale);
  };
  if (kept.rows.size() < kept.rows_in_file) {
    if (start && kept.rows.front() > 0) imported.start_s = seconds(*start);
    if (has_times && kept.period) imported.period_s = seconds(*kept.period);
    imported.rows = std::move(kept.rows);
  }
  imported.is_driven_before = kept.is_driven_before;
  std::ranges::move(kept.notes, std::back_inserter(imported.assumptions));
  std::ranges::move(kept.warnings, std::back_inserter(imported.warnings));
}

void read_mapped(ForeignFile& file, const FileChoice& choice, ImportedFile& imported) {
  const std::string name = arm::shown(imported.file);
  if (choice.period_s) add_times(file.table, *choice.period_s);
  auto labels = measured::labels_of(file.table);
  for (const auto place : choice.columns.left_out_places(labels)) {
    file.table.columns[place].is_left_out = true;
  }
  if (choice.controller) {
    // The reference is no other quantity.
    if (const auto place = choice.columns.reference_place(labels)) {
      file.table.columns[*place].is_left_out = true;
    }
  }
  labels = measured::labels_of(file.table);
  auto guess =
      measured::guess_columns(labels, choice.columns.mappings(labels, imported.assumptions));
  choice.columns.set_time_unit(guess.mappings);
  require_told(guess, labels, file, choice.is_one_of_several);
  const std::vector<std::string> names = measured::column_names(labels);
  auto used = measured::places_used(guess.mappings, names);
  if (choice.controller) {
    imported.reference = choice.columns.reference_column(labels, guess.mappings, *choice.controller,
                                                         imported.assumptions);
    const auto more = measured::places_used({{"", imported.reference->mapping}}, names);
    used.insert(used.end(), more.begin(), more.end());
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::count(used, i) == 0) imported.not_used.push_back(names[i]);
  }
  imported.assumptions.insert(imported.assumptions.end(), guess.notes.begin(), guess.notes.end());
  for (const auto& [quantity, mapping] : guess.mappings) {
    for (const auto place : measured::places_used({{quantity, mapping}}, names)) {
      auto& column = file.table.columns[place];
      const bool is_angle = quantity == "hub_angle" && mapping.expression.empty();
      const std::string note = is_angle ? measured::unwrap(column, mapping.unit, mapping.scale)
                                        : measured::unwrap(column, column.unit);
      if (!note.empty()) imported.assumptions.push_back(note);
    }
  }
  std::ranges::move(unit_contradictions(guess.mappings, labels),
                    std::back_inserter(imported.warnings));
  imported.warnings.insert(imported.warnings.end(), guess.warnings.begin(), guess.warnings.end());
  for (const auto& question : guess.questions) {
    const bool is_needed_for_torque = question.may_be_torque && guess.mappings.contains("torque");
    if (is_needed_for_torque || !is_unused(question.column, imported)) continue;
    imported.warnings.push_back("not imported: " + question.sentence);
  }
  for (const auto& sentence : measured::stray_texts(file.table)) {
    imported.warnings.push_back("not imported: " + sentence);
  }
  imported.columns = std::move(guess.mappings);
  leave_out_incomplete(file.table, choice, imported);
  measured::TimeRecord record = uneven_record_of(file.table, imported.columns, name);
  if (imported.reference) {
    const auto& [sensor, mapping] = *imported.reference;
    record.reference = reference_of(file.table, mapping, sensor, record.time_s, name);
    warn_of_unrecorded(*choice.controller, imported);
  }
  if (!choice.period_s) {
    require_running(record.time_s, file.table);
    std::ranges::move(second_clocks(file.table, record.time_s, imported.not_used),
                      std::back_inserter(imported.warnings));
  }
  imported.data = std::move(record);
  doubt_time(choice, imported);
}

}  // namespace

void add_times(ForeignTable& table, double period_s) {
  arm::require_in_range("--period", period_s, "s", arm::kPositive);
  std::erase_if(table.columns, [](const auto& column) { return column.is_made; });
  const auto& first = table.columns.front();
  const std::size_t rows = first.is_text() ? first.texts.size() : first.values.size();
  table.columns.push_back({"time [s]", "s", measured::grid_points({0.0, period_s}, rows)});
}

ReadFile read_file(const std::string& path, const FileChoice& choice) {
  if (choice.raw_columns) {
    ForeignFile contents;
    contents.table = measured::read_raw_doubles(path, *choice.raw_columns);
    return {path, "raw doubles", std::move(contents)};
  }
  ForeignFile contents = measured::read_foreign_file(path);
  std::string format = to_string(contents.format);
  return {path, std::move(format), std::move(contents)};
}

ImportedFile import_file(ReadFile read, const FileChoice& choice) {
  const std::string name = arm::shown(read.file);
  ForeignFile& file = read.contents;
  ImportedFile imported;
  imported.file = read.file;
  imported.format = read.format;
  try {
    take_typed_responses(file, choice);
    imported.assumptions = file.table.assumptions;
    imported.kind = kind_of(file, choice.kind);
    const bool is_long_form =
        imported.kind == RunKind::modal ||
        (imported.kind == RunKind::frf && file.format == measured::ForeignFormat::text &&
         is_record_form(file.table));
    if (is_long_form && !choice.columns.empty()) {
      throw InputError(
          "--column, --compute, --reference: not applicable, this file names its columns");
    }
    if (choice.period_s && imported.kind != RunKind::time) {
      throw InputError("--period: only for time signals");
    }
    if (!file.modes.empty() && imported.kind == RunKind::modal) {
      imported.data = file.modes;
    } else if (is_long_form) {
      read_text_kind(file, imported);
    } else if (imported.kind == RunKind::frf) {
      read_responses(file, choice, imported);
    } else {
      read_mapped(file, choice, imported);
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(name + ":") ||
        std::string_view(error.what()).starts_with("--")) {
      throw;
    }
    throw arm::located(error, name, 0);
  }
  imported.not_used.insert(imported.not_used.end(), file.left_out.begin(), file.left_out.end());
  return imported;
}

}  // namespace flexarm::importing
