#include "measured/files/time_record.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/csv.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/number_cell.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/time_grid.hpp"
#include "measured/files/unit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace flexarm::measured {

namespace {

using arm::InputError;

/// Columns that a file must have: of a time record, and of one that is read for its reference.
constexpr std::array kOfRecord = {kTime, kTorque};
constexpr std::array kOfReference = {kTime, kReferenceColumn};

/// The header of a file that must have those columns.
std::string_view form(std::span<const std::string_view> required) {
  return required.back() == kReferenceColumn ? "time [s],reference [rad]"
                                             : "time [s],torque [N m],hub_angle [rad],...";
}

/// The SI units of sensors, in any of which a reference may be.
constexpr std::array<std::string_view, 5> kSensorUnits = {"rad", "rad/s", "m", "m/s^2", "1"};

/// A column of the file; `sensor` is empty for time, torque and reference.
struct Column {
  std::string name;  ///< without its unit: "hub_angle"
  Unit unit;
  std::string_view si_unit;
  std::optional<arm::Sensor> sensor;
  std::vector<double> values;
};

/// The unit in "NAME [UNIT]"; empty when there is none.
std::optional<std::string_view> unit_in(std::string_view header) {
  const auto open = header.find('[');
  if (open == std::string_view::npos || !header.ends_with(']')) return std::nullopt;
  return header.substr(open + 1, header.size() - open - 2);
}

std::string_view name_in(std::string_view header) {
  const std::string_view name = header.substr(0, header.find('['));
  return name.substr(0, name.find_last_not_of(" \t") + 1);
}

/// The sensor of that name. The error says, unlike `arm::parse_sensor`, that time and torque are
/// columns too.
arm::Sensor sensor_of(std::string_view name) {
  const std::vector<std::string> beside = {std::string(kTime), std::string(kTorque),
                                           std::string(kReferenceColumn)};
  if (const auto meant = arm::nearest_name(name, beside)) {
    throw InputError(
        fmt::format("column {}: unknown (did you mean {}?)", arm::shown(name), *meant));
  }
  try {
    return arm::parse_sensor(name);
  } catch (const InputError& error) {
    throw InputError(fmt::format("column: {}; besides time, torque and reference", error.what()));
  }
}

/// Sets the column's unit: `given`, which belongs to one of `si_units`.
void take_unit(Column& column, std::optional<std::string_view> given,
               std::span<const std::string_view> si_units) {
  std::vector<std::string> names;
  for (const std::string_view si_unit : si_units) {
    for (const auto& unit : units_for(si_unit)) {
      names.emplace_back(unit.name);
      if (unit.name != given) continue;
      column.unit = unit;
      column.si_unit = si_unit;
      return;
    }
  }
  const std::string& name = column.name;
  if (!given) {
    throw InputError(fmt::format("column {}: unit missing; write {} [{}]; allowed: {}",
                                 arm::shown(name), name, si_units.front(), fmt::join(names, ", ")));
  }
  throw InputError(fmt::format("column {}: unit {} unknown{}; allowed: {}", name,
                               arm::shown(*given), arm::did_you_mean(*given, names),
                               fmt::join(names, ", ")));
}

Column read_column(std::string_view header) {
  Column column;
  const std::string_view name = name_in(header);
  column.name = name;
  if (name == kReferenceColumn) {
    take_unit(column, unit_in(header), kSensorUnits);
    return column;
  }
  std::array<std::string_view, 1> si_unit = {"s"};
  if (name == kTorque) {
    si_unit = {"N m"};
  } else if (name != kTime) {
    column.sensor = sensor_of(name);
    column.name = arm::to_string(*column.sensor);
    si_unit = {arm::unit(*column.sensor)};
  }
  take_unit(column, unit_in(header), si_unit);
  return column;
}

std::vector<Column> read_time_header(std::span<const std::string_view> cells,
                                     std::span<const std::string_view> required) {
  if (cells.size() == 1 && cells[0].find_first_of(";\t") != std::string::npos) {
    throw InputError("cells must be separated by commas, and numbers have a decimal point");
  }
  std::vector<Column> columns;
  for (const auto& cell : cells) {
    Column column = read_column(cell);
    if (std::ranges::count(columns, column.name, &Column::name) > 0) {
      throw InputError(fmt::format("column {}: given twice", column.name));
    }
    columns.push_back(std::move(column));
  }
  for (const auto& name : required) {
    if (std::ranges::count(columns, name, &Column::name) == 0) {
      throw InputError(fmt::format("column {}: missing; the header is {}", name, form(required)));
    }
  }
  return columns;
}

double read_value(const Column& column, std::string_view cell) {
  if (const auto number = number_cell<double>(cell)) {
    const double value = column.unit.to_si(*number);
    if (std::isfinite(value)) return value;
  }
  throw InputError(fmt::format("{} = {}{}{}: must be a finite number{}", column.name,
                               arm::shown(cell), cell.empty() ? "" : " ",
                               cell.empty() ? "" : column.unit.name,
                               cell.empty() ? "; no cell may be empty" : ""));
}

void read_row(std::span<const std::string_view> cells, std::vector<Column>& columns) {
  if (cells.size() != columns.size()) {
    throw InputError(fmt::format("{} cell{}; the header has {} (numbers have a decimal point)",
                                 cells.size(), cells.size() == 1 ? "" : "s", columns.size()));
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    columns[i].values.push_back(read_value(columns[i], cells[i]));
  }
}

TimeRecord record_of(std::vector<Column>&& columns) {
  TimeRecord record;
  for (auto& column : columns) {
    if (column.sensor) {
      record.channels.push_back({*column.sensor, std::move(column.values)});
    } else if (column.name == kReferenceColumn) {
      record.reference = {std::string(column.si_unit), std::move(column.values)};
    } else {
      (column.name == kTime ? record.time_s : record.torque_N_m) = std::move(column.values);
    }
  }
  return record;
}

void require_finite_values(std::string_view name, const std::vector<double>& values) {
  const auto bad = std::ranges::find_if(values, [](double value) { return !std::isfinite(value); });
  if (bad == values.end()) return;
  throw InputError(fmt::format("{} = {} in sample {}: must be a finite number", name, *bad,
                               bad - values.begin() + 1));
}

/// The shortest decimal that reads back to the same double.
void append_number(std::string& out, double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}

}  // namespace

const std::vector<double>* values_of(const TimeRecord& record, arm::SensorKind kind) {
  const auto found = std::ranges::find_if(
      record.channels, [&](const Channel& channel) { return channel.sensor.kind == kind; });
  return found == record.channels.end() ? nullptr : &found->values;
}

double sampling_period_s(const TimeRecord& record) {
  return (record.time_s.back() - record.time_s.front()) /
         static_cast<double>(record.time_s.size() - 1);
}

namespace {

TimeRecord parse_record(std::string_view csv, const std::string& file_name,
                        std::span<const std::string_view> required) {
  CsvReader reader(csv);
  std::vector<Column> columns;
  std::vector<int> lines;
  try {
    if (!reader.next()) throw InputError(fmt::format("empty; the header is {}", form(required)));
    columns = read_time_header(reader.cells(), required);
    while (reader.next()) {
      read_row(reader.cells(), columns);
      lines.push_back(reader.line());
    }
    if (lines.size() < 2) {
      throw InputError(lines.empty() ? "only a header; needs at least two samples"
                                     : "one sample; needs at least two");
    }
  } catch (const InputError& error) {
    throw arm::located(error, file_name, reader.line());
  }
  TimeRecord record = record_of(std::move(columns));
  if (const auto fault = grid_fault(record.time_s)) {
    throw arm::located(fault->error, file_name, lines[fault->sample]);
  }
  return record;
}

}  // namespace

void require_valid(const TimeRecord& record) {
  const std::size_t samples = record.time_s.size();
  const auto require_length = [&](std::string_view name, std::size_t length) {
    if (length == samples) return;
    throw InputError(fmt::format("{}: {} values; must be {}, one for each time", name, length,
                                 samples));
  };
  const Reference& reference = record.reference;
  require_length(kTorque, record.torque_N_m.size());
  if (!reference.values.empty()) require_length(kReferenceColumn, reference.values.size());
  for (const auto& channel : record.channels) {
    const std::string name = arm::to_string(channel.sensor);
    require_length(name, channel.values.size());
    if (std::ranges::count(record.channels, channel.sensor, &Channel::sensor) > 1) {
      throw InputError(fmt::format("{}: given twice", name));
    }
  }
  if (samples < 2) throw InputError(fmt::format("{} samples; needs at least two", samples));
  if (std::ranges::count(kSensorUnits, reference.unit) != (reference.values.empty() ? 0 : 1)) {
    throw InputError(fmt::format("{}: unit {}; must be one of {}", kReferenceColumn,
                                 arm::shown(reference.unit), fmt::join(kSensorUnits, ", ")));
  }
  require_finite_values(kReferenceColumn, reference.values);
  require_finite_values(kTime, record.time_s);
  require_finite_values(kTorque, record.torque_N_m);
  for (const auto& channel : record.channels) {
    require_finite_values(arm::to_string(channel.sensor), channel.values);
  }
  if (const auto fault = grid_fault(record.time_s)) {
    throw InputError(fmt::format("sample {}: {}", fault->sample + 1, fault->error.what()));
  }
}

TimeRecord parse_time_record(std::string_view csv, const std::string& file_name) {
  return parse_record(csv, file_name, kOfRecord);
}

TimeRecord read_time_record(const std::filesystem::path& path) {
  return read_file_as(FileKind::time_record, path, kLargestRecord_bytes, parse_time_record);
}

TimeRecord read_reference(const std::filesystem::path& path) {
  TimeRecord record = read_file_as(FileKind::time_record, path, kLargestRecord_bytes,
                                   [](const std::string& text, const std::string& file_name) {
                                     return parse_record(text, file_name, kOfReference);
                                   });
  record.torque_N_m.assign(record.time_s.size(), 0.0);
  record.channels.clear();
  return record;
}

std::string format_time_record(const TimeRecord& record) {
  require_valid(record);
  std::string out = "time [s],torque [N m]";
  for (const auto& channel : record.channels) {
    out += fmt::format(",{} [{}]", arm::to_string(channel.sensor), arm::unit(channel.sensor));
  }
  const Reference& reference = record.reference;
  if (!reference.values.empty()) out += fmt::format(",{} [{}]", kReferenceColumn, reference.unit);
  out += '\n';
  for (std::size_t i = 0; i < record.time_s.size(); ++i) {
    append_number(out, record.time_s[i]);
    out += ',';
    append_number(out, record.torque_N_m[i]);
    for (const auto& channel : record.channels) {
      out += ',';
      append_number(out, channel.values[i]);
    }
    if (!reference.values.empty()) {
      out += ',';
      append_number(out, reference.values[i]);
    }
    out += '\n';
  }
  return out;
}

void write_time_record(const TimeRecord& record, const std::filesystem::path& path) {
  measured::write_atomically(path, format_time_record(record));
}

}  // namespace flexarm::measured
