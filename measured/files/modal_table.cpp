#include "measured/files/modal_table.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"
#include "arm/range.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/csv.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/number_cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>

namespace flexarm::measured {

namespace {

using arm::InputError;

constexpr std::size_t kLargestModalTable_bytes = 1 << 24;

constexpr const char* kSensor = "sensor";
constexpr const char* kFeature = "feature";
constexpr const char* kOrder = "order";

/// Work and memory grow with the modes up to the largest of these.
constexpr int kMostOrder = 1000;
constexpr double kMostFrequency_Hz = 1e6;

/// A column of numbers; cells may be empty.
struct NumberColumn {
  const char* name;
  arm::Range range;
  std::optional<double> ModalEntry::*member;
};

constexpr std::array<NumberColumn, 6> kNumbers = {{
    {"frequency [Hz]", arm::kPositive, &ModalEntry::frequency_Hz},
    {"frequency_std [Hz]", arm::kNotNegative, &ModalEntry::frequency_std_Hz},
    {"damping_ratio", arm::kAnyFinite, &ModalEntry::damping_ratio},
    {"damping_ratio_std", arm::kNotNegative, &ModalEntry::damping_ratio_std},
    {"shape_re", arm::kAnyFinite, &ModalEntry::shape_re},
    {"shape_im", arm::kAnyFinite, &ModalEntry::shape_im},
}};

/// The last of them.
constexpr std::size_t kShapeColumns = 2;

const std::vector<std::string>& table_columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {kSensor, kFeature, kOrder};
    for (const auto& column : kNumbers) all.emplace_back(column.name);
    return all;
  }();
  return names;
}

/// The header line; most tables have no shapes.
std::string header_line(bool has_shapes) {
  const std::span names(table_columns());
  return fmt::format("{}",
                     fmt::join(names.first(names.size() - (has_shapes ? 0 : kShapeColumns)), ","));
}

/// " (did you mean ...?)", also for a column without its unit.
std::string meant_column(const std::string& typed) {
  for (const auto& name : table_columns()) {
    if (name.starts_with(typed + " [")) return fmt::format(" (did you mean {}?)", name);
  }
  return arm::did_you_mean(typed, table_columns());
}

/// Where each column stands in a row.
using ModalHeader = std::map<std::string, std::size_t>;

ModalHeader read_modal_header(const CsvRow& row) {
  if (row.cells.size() == 1 && row.cells[0].find_first_of(";\t") != std::string::npos) {
    throw InputError("cells must be separated by commas, and numbers have a decimal point");
  }
  ModalHeader header;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string& name = row.cells[i];
    if (std::ranges::count(table_columns(), name) == 0) {
      throw InputError(fmt::format("column {}: unknown{}; allowed: {}", arm::shown(name),
                                   meant_column(name), fmt::join(table_columns(), ", ")));
    }
    if (!header.emplace(name, i).second) {
      throw InputError(fmt::format("column {}: given twice", name));
    }
  }
  for (const char* name : {kSensor, kFeature, kNumbers[0].name}) {
    if (!header.contains(name)) {
      throw InputError(
          fmt::format("column {}: missing; the header is {}", name, header_line(false)));
    }
  }
  return header;
}

double read_value(const NumberColumn& column, const std::string& cell) {
  const bool is_ratio = column.member == &ModalEntry::damping_ratio;
  const std::string allowed = is_ratio
                                  ? "from -1 to 1, a fraction of critical damping, not in percent"
                                  : to_string(column.range);
  const auto value = number_cell<double>(cell);
  if (!value || !column.range.contains(*value) || (is_ratio && std::abs(*value) > 1.0)) {
    throw InputError(
        fmt::format("{} = {}: must be {}, or empty", column.name, arm::shown(cell), allowed));
  }
  return *value;
}

Feature read_feature(const std::string& cell) {
  for (const Feature feature : {Feature::pole, Feature::zero}) {
    if (cell == to_string(feature)) return feature;
  }
  throw InputError(
      fmt::format("feature = {}: must be pole or zero{}", arm::shown(cell),
                  arm::did_you_mean(cell, std::array<std::string, 2>{"pole", "zero"})));
}

void require_shape_in_place(const ModalEntry& entry) {
  if (!entry.shape_re && !entry.shape_im) return;
  if (!entry.shape_re) throw InputError("shape_im: given without shape_re");
  if (entry.feature == Feature::pole && entry.sensor) return;
  throw InputError("shape_re: only for a pole with a sensor; it is the mode shape at that sensor");
}

ModalEntry read_entry(const CsvRow& row, const ModalHeader& header) {
  if (row.cells.size() != header.size()) {
    throw InputError(fmt::format("{} cells; the header has {} (numbers have a decimal point)",
                                 row.cells.size(), header.size()));
  }
  ModalEntry entry;
  entry.feature = read_feature(row.cells[header.at(kFeature)]);

  const std::string& sensor = row.cells[header.at(kSensor)];
  if (!sensor.empty()) {
    entry.sensor = arm::parse_sensor(sensor);
  } else if (entry.feature == Feature::zero) {
    throw InputError("sensor: missing; a zero belongs to one sensor");
  }

  const auto order = header.find(kOrder);
  if (order != header.end() && !row.cells[order->second].empty()) {
    const std::string& cell = row.cells[order->second];
    entry.order = number_cell<int>(cell).value_or(0);
    if (*entry.order < 1 || *entry.order > kMostOrder) {
      throw InputError(fmt::format("order = {}: must be a whole number from 1 to {}, or empty",
                                   arm::shown(cell), kMostOrder));
    }
  }

  for (const auto& column : kNumbers) {
    const auto place = header.find(column.name);
    if (place == header.end() || row.cells[place->second].empty()) continue;
    entry.*column.member = read_value(column, row.cells[place->second]);
  }
  if (entry.frequency_Hz.value_or(0.0) > kMostFrequency_Hz) {
    throw InputError(fmt::format("frequency [Hz] = {}: must be at most {:g} Hz",
                                 arm::shown(row.cells[header.at(kNumbers[0].name)]),
                                 kMostFrequency_Hz));
  }
  require_shape_in_place(entry);
  return entry;
}

std::string sensor_name(const ModalEntry& entry) {
  return entry.sensor ? arm::to_string(*entry.sensor) : "";
}

}  // namespace

std::string_view to_string(Feature feature) {
  return feature == Feature::pole ? "pole" : "zero";
}

ModalTable parse_modal_table(std::string_view csv, const std::string& file_name) {
  const std::vector<CsvRow> rows = parse_csv(csv, file_name);
  int line = rows.empty() ? 1 : rows.front().line;
  try {
    if (rows.empty()) {
      throw InputError("empty; the header is " + header_line(false));
    }
    const ModalHeader header = read_modal_header(rows.front());
    ModalTable table;
    std::map<std::string, int> line_of;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      line = rows[i].line;
      const ModalEntry entry = read_entry(rows[i], header);
      table.push_back(entry);
      if (!entry.order) continue;
      const std::string what =
          fmt::format("{} {} {}", sensor_name(entry), to_string(entry.feature), *entry.order);
      if (const auto [first, is_new] = line_of.emplace(what, line); !is_new) {
        throw InputError(fmt::format("{}: given twice; first on line {}", what, first->second));
      }
    }
    return table;
  } catch (const InputError& error) {
    throw arm::located(error, file_name, line);
  }
}

ModalTable read_modal_table(const std::filesystem::path& path, const std::string& required) {
  return read_file_as(FileKind::modal_table, path, kLargestModalTable_bytes, parse_modal_table,
                      required);
}

std::string format_modal_table(const ModalTable& table) {
  const bool has_shapes = std::ranges::any_of(
      table, [](const ModalEntry& entry) { return entry.shape_re.has_value(); });
  std::string out = header_line(has_shapes) + "\n";
  for (const auto& entry : table) {
    out += fmt::format("{},{},{}", sensor_name(entry), to_string(entry.feature),
                       entry.order ? std::to_string(*entry.order) : "");
    for (const auto& column :
         std::span(kNumbers).first(kNumbers.size() - (has_shapes ? 0 : kShapeColumns))) {
      const auto value = entry.*column.member;
      out += value ? fmt::format(",{}", *value) : ",";
    }
    out += '\n';
  }
  return out;
}

void require_valid(const ModalTable& table) {
  constexpr std::string_view kName = "entries:";
  try {
    parse_modal_table(format_modal_table(table), "entries");
  } catch (const InputError& error) {
    const std::string text = error.what();  // "entries:3: ..." of the second entry
    const std::size_t end = text.find(": ");
    const auto line = arm::parse_number<int>(text.substr(kName.size(), end - kName.size()));
    throw InputError(line ? fmt::format("entry {}{}", *line - 1, text.substr(end)) : text);
  }
}

void write_modal_table(const ModalTable& table, const std::filesystem::path& path) {
  measured::write_atomically(path, format_modal_table(table));
}

}  // namespace flexarm::measured
