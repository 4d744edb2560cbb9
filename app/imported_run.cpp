#include "app/imported_run.hpp"

#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "measured/files/universal_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace flexarm::app {

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

/// What the file holds; more than one only beside each other in a universal or MATLAB file.
std::vector<RunKind> kinds_of(const ForeignFile& file) {
  if (file.format == measured::ForeignFormat::text) {
    if (has_columns(file.table, {"sensor", "feature"})) return {RunKind::modal};
    if (has_columns(file.table, {"sensor", "re"})) return {RunKind::frf};
    return {RunKind::time};
  }
  std::vector<RunKind> kinds;
  if (!file.responses.empty()) kinds.push_back(RunKind::frf);
  // A vector of frequencies alone is no signal in time.
  if (!file.table.columns.empty() && (kinds.empty() || file.table.columns.size() > 1)) {
    kinds.push_back(RunKind::time);
  }
  return kinds;
}

RunKind kind_of(const ForeignFile& file, std::optional<RunKind> given) {
  const auto kinds = kinds_of(file);
  if (!given && kinds.size() == 1) return kinds.front();
  if (!given) {
    throw InputError(
        "contains time signals and frequency responses; choose with --kind time or --kind frf");
  }
  if (std::ranges::count(kinds, *given) > 0) return *given;
  throw InputError(fmt::format("--kind {}: the file contains {}", to_string(*given),
                               kinds.front() == RunKind::time  ? "time signals"
                               : kinds.front() == RunKind::frf ? "frequency responses"
                                                               : "a modal table"));
}

/// A table with texts in it as CSV, each row on the line that it has in the file.
std::string csv_of(const ForeignTable& table) {
  std::vector<std::string> names;
  for (const auto& column : table.columns) names.push_back(column.name);
  std::string out;
  int line = 1;
  for (; line + 1 < table.line_of_row.front(); ++line) out += '\n';
  out += fmt::format("{}\n", fmt::join(names, ","));
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

std::vector<ColumnLabel> labels_of(const ForeignFile& file, RunKind kind) {
  std::vector<ColumnLabel> labels;
  if (kind == RunKind::time) {
    for (const auto& column : file.table.columns) {
      if (!column.is_text()) labels.push_back({column.name, column.unit});
    }
  } else {
    for (const auto& response : file.responses) labels.push_back({response.name, response.unit});
  }
  return labels;
}

std::string join_names(const std::vector<ColumnLabel>& labels) {
  std::vector<std::string> names;
  for (const auto& label : labels) names.push_back(label.name);
  return arm::shown(fmt::format("{}", fmt::join(names, ", ")), 400);
}

/// Times for a file without any.
void add_times(ForeignTable& table, double period_s) {
  arm::require_in_range("--period", period_s, "s", arm::kPositive);
  const auto& first = table.columns.front();
  const std::size_t rows = first.is_text() ? first.texts.size() : first.values.size();
  table.columns.push_back({"time [s]", "s", measured::grid_points({0.0, period_s}, rows)});
}

void require_told(const measured::ColumnMappings& mappings,
                  const std::vector<ColumnLabel>& labels) {
  for (const auto& [quantity, otherwise] :
       {std::pair{"time", ", or the sampling period with --period"}, std::pair{"torque", ""}}) {
    if (mappings.contains(quantity)) continue;
    throw InputError(fmt::format(
        "{0}: column not recognised; columns: {1}; assign one with --column {0}=NAME:UNIT:SCALE{2}",
        quantity, join_names(labels), otherwise));
  }
}

void read_text_kind(const ForeignFile& file, const std::string& name, ImportedRun& run) {
  const std::string csv = csv_of(file.table);
  if (run.kind == RunKind::modal) {
    run.data = measured::parse_modal_table(csv, name);
  } else {
    run.data = measured::parse_frequency_record(csv, name);
  }
}

void read_mapped(ForeignFile& file, const std::string& name, const ColumnChoice& columns,
                 std::optional<double> period_s, ImportedRun& run) {
  const bool in_time = run.kind == RunKind::time;
  if (in_time && period_s) add_times(file.table, *period_s);
  const auto labels = labels_of(file, run.kind);
  auto guess = measured::guess_columns(labels, columns.mappings(labels));
  if (in_time) {
    require_told(guess.mappings, labels);
  } else {
    // Time and torque are no responses.
    std::erase_if(guess.mappings,
                  [](const auto& entry) { return !measured::sensor_of(entry.first).has_value(); });
  }
  for (const auto& label : labels) {
    const bool is_used = std::ranges::any_of(
        guess.mappings, [&](const auto& entry) { return entry.second.name == label.name; });
    if (!is_used) run.not_used.push_back(label.name);
  }
  run.assumptions.insert(run.assumptions.end(), guess.notes.begin(), guess.notes.end());
  run.columns = std::move(guess.mappings);
  if (in_time) {
    run.data = time_record_of(file.table, run.columns, name);
  } else {
    run.data = frequency_record_of(file, run.columns, name);
  }
}

}  // namespace

ImportedRun import_run(const std::string& path, std::optional<RunKind> kind,
                       const ColumnChoice& columns, std::optional<double> period_s) {
  const std::string name = arm::shown(path);
  ForeignFile file = measured::read_foreign_file(path);
  ImportedRun run;
  run.format = file.format;
  run.assumptions = file.table.assumptions;
  try {
    run.kind = kind_of(file, kind);
    const bool is_long_form =
        run.kind != RunKind::time && file.format == measured::ForeignFormat::text;
    if (is_long_form && !columns.typed.empty()) {
      throw InputError("--column: not applicable, this file names its columns");
    }
    if (period_s && run.kind != RunKind::time) throw InputError("--period: only for time signals");
    if (is_long_form) {
      read_text_kind(file, name, run);
    } else {
      read_mapped(file, name, columns, period_s, run);
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(name + ":") ||
        std::string_view(error.what()).starts_with("--")) {
      throw;
    }
    throw arm::located(error, name, 0);
  }
  for (const auto& column : file.table.columns) {
    if (column.is_text() && run.kind == RunKind::time) run.not_used.push_back(column.name);
  }
  run.not_used.insert(run.not_used.end(), file.left_out.begin(), file.left_out.end());
  return run;
}

}  // namespace flexarm::app
