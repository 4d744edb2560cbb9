#include "measured/files/column_mapping.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/files/column_expression.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/time_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::InputError;

/// What becomes a quantity.
struct Source {
  std::string quantity;  ///< standard name
  ColumnMapping mapping;
  std::string name = quantity;  ///< in an error
};

/// The place of the column of that name. Throws InputError where none has it, or several.
std::size_t only_column(const ForeignTable& table, const std::string& name) {
  const std::size_t place = find_column(table, name);
  const auto alike = std::ranges::count(table.columns, name, &ForeignColumn::name);
  if (alike > 1) {
    throw InputError(
        fmt::format("column {}: {} columns of the file have this name; take one by its number, as "
                    "in #{}",
                    arm::shown(name), alike, place + 1));
  }
  return place;
}

/// What each column of the table is, by its place.
std::vector<std::optional<Source>> sources_of(const ForeignTable& table,
                                              const ColumnMappings& mappings) {
  std::vector<std::optional<Source>> sources(table.columns.size());
  for (const auto& [quantity, mapping] : mappings) {
    if (!mapping.expression.empty()) continue;
    const std::size_t place = only_column(table, mapping.name);
    if (sources[place]) {
      throw InputError(fmt::format("column {}: assigned to {} and {}", arm::shown(mapping.name),
                                   sources[place]->quantity, quantity));
    }
    sources[place] = Source{quantity, mapping};
  }
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i]) continue;
    const auto standard = mapping_by_header(table.columns[i], mappings);
    if (standard.empty()) continue;
    std::optional<Source> source = Source{standard.begin()->first, standard.begin()->second};
    const bool is_taken = std::ranges::any_of(
        sources, [&](const auto& other) { return other && other->quantity == source->quantity; });
    if (is_taken) throw InputError(fmt::format("column {}: given twice", source->quantity));
    sources[i] = std::move(source);
  }
  return sources;
}

/// `what` names the numbers in an error: "column u".
std::vector<double> si_values(const ForeignTable& table, const std::vector<double>& numbers,
                              const std::string& what, const Source& source, std::size_t& row) {
  const auto& mapping = source.mapping;
  const Unit unit = unit_of(source.quantity, mapping.unit).value_or(Unit{mapping.unit});
  std::vector<double> values;
  values.reserve(numbers.size());
  for (row = 0; row < numbers.size(); ++row) {
    values.push_back(unit.to_si(numbers[row] * mapping.scale));
    if (std::isfinite(values.back()) && is_reading(numbers[row])) continue;
    throw InputError(fmt::format(
        "{}: {} = {}{}: must be a finite number{}", source.name, what, numbers[row],
        table.line_of_row.empty() ? fmt::format(" in row {}", row + 1) : " (or an empty cell)",
        std::isnan(numbers[row]) || is_over_range(numbers[row])
            ? "; flexarm import takes such rows as missing samples"
            : ""));
  }
  row = 0;
  return values;
}

std::vector<double> column_values(const ForeignTable& table, const ForeignColumn& column,
                                  const Source& source, std::size_t& row) {
  if (column.is_text()) {
    row = column.stray_row;
    throw InputError(fmt::format("column {} = {}: not a number; {} must be numeric",
                                 arm::shown(column.name), arm::shown(column.texts[row]),
                                 source.name));
  }
  return si_values(table, column.values, "column " + arm::shown(column.name), source, row);
}

void add_quantity(TimeRecord& record, const std::string& quantity, std::vector<double> values) {
  if (const auto sensor = sensor_of(quantity)) {
    record.channels.push_back({*sensor, std::move(values)});
  } else {
    (quantity == kTime ? record.time_s : record.torque_N_m) = std::move(values);
  }
}

std::vector<double> computed_values(const ForeignTable& table, const Source& source,
                                    std::span<const double> times_s, std::size_t& row) {
  const auto& expression = source.mapping.expression;
  std::vector<double> numbers;
  try {
    numbers = evaluate_expression(expression, table, times_s);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", source.name, error.what()));
  }
  return si_values(table, numbers, "expression " + arm::shown(expression), source, row);
}

}  // namespace

std::string standard_name(std::string_view name) {
  if (name == kTime || name == kTorque) return std::string(name);
  const std::vector<std::string> beside = {std::string(kTime), std::string(kTorque)};
  if (const auto meant = arm::nearest_name(name, beside)) {
    throw InputError(fmt::format("{}: unknown (did you mean {}?)", arm::shown(name), *meant));
  }
  try {
    return arm::to_string(arm::parse_sensor(name));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; besides time and torque", error.what()));
  }
}

bool is_doubtful_place(std::string_view standard_name) {
  constexpr double kFarthest_m = 5.0;
  const auto sensor = sensor_of(standard_name);
  return sensor && sensor->kind == arm::SensorKind::strain && sensor->position_m >= kFarthest_m;
}

std::optional<arm::Sensor> sensor_of(std::string_view standard_name) {
  if (standard_name == kTime || standard_name == kTorque) return std::nullopt;
  return arm::parse_sensor(standard_name);
}

std::string_view si_unit_of(std::string_view standard_name) {
  if (standard_name == kTime) return "s";
  if (standard_name == kTorque) return "N m";
  return arm::unit(arm::parse_sensor(standard_name));
}

std::optional<Unit> unit_of(std::string_view standard_name, std::string_view unit) {
  const auto units = units_for(si_unit_of(standard_name));
  if (unit.empty()) return units.front();
  const auto found = std::ranges::find(units, canonical_unit(unit), &Unit::name);
  if (found == units.end()) return std::nullopt;
  return *found;
}

double scale_of_unit(std::string_view standard_name, std::string_view unit) {
  return other_unit_scale(si_unit_of(standard_name), canonical_unit(unit)).value_or(1.0);
}

std::optional<double> conversion_of(std::string_view standard_name, std::string_view unit) {
  if (const auto known = unit_of(standard_name, unit)) return known->to_si(1.0);
  return other_unit_scale(si_unit_of(standard_name), canonical_unit(unit));
}

ColumnMappings mapping_by_header(const ForeignColumn& column, const ColumnMappings& mappings) {
  if (column.is_left_out || column.holds_nothing()) return {};
  ColumnMappings standard = standard_mapping(column.name);
  if (!standard.empty() && mappings.contains(standard.begin()->first)) return {};
  return standard;
}

bool repeats_conversion(std::string_view standard_name, std::string_view unit, double scale) {
  constexpr double kAlike = 0.01;
  constexpr double kTwoDigits = 0.05;  // 1.05 as 1.1
  const double own = conversion_of(standard_name, unit).value_or(1.0);
  if (own != 1.0 && std::abs(std::abs(scale) * own - 1.0) < kAlike) {
    throw InputError(fmt::format(
        "scale = {0:.6g}: the inverse of the conversion of {1}, {2:.6g}, which is applied already; "
        "leave it out if the numbers are in {1}; write unit {3} if they are in {3}",
        scale, unit, own, si_unit_of(standard_name)));
  }
  const double off = std::abs(std::abs(scale) / own - 1.0);
  if (own == 1.0 || off > kTwoDigits) return false;
  if (off < kAlike) return true;
  throw InputError(fmt::format(
      "scale = {0:.6g}: {1:.2g} % off the conversion of {2}, {3:.6g}; write unit {4}, with scale "
      "{0:.9g} if it is the whole conversion, {5:.9g} if it is in {2}",
      scale, 100.0 * off, unit, own, si_unit_of(standard_name), scale * own));
}

bool is_unit_of(std::string_view standard_name, std::string_view unit) {
  return conversion_of(standard_name, unit).has_value();
}

std::vector<std::string> unit_names(std::string_view standard_name) {
  const std::string_view si_unit = si_unit_of(standard_name);
  std::vector<std::string> names;
  for (const auto& unit : units_for(si_unit)) names.emplace_back(unit.name);
  for (const auto name : other_units(si_unit)) names.emplace_back(name);
  return names;
}

void require_valid(const std::string& standard_name, const ColumnMapping& mapping, bool has_scale) {
  if (!mapping.expression.empty()) {
    if (!mapping.name.empty()) {
      throw InputError("expression: given beside name; only one of the two");
    }
    require_expression(mapping.expression);
  } else if (mapping.name.empty()) {
    throw InputError(
        "name: missing; must be a column of the file, or expression a formula of its columns");
  }
  if (!std::isfinite(mapping.scale) || mapping.scale == 0.0) {
    throw InputError(fmt::format("scale = {}: must be a finite number, not 0", mapping.scale));
  }
  if (has_scale || is_unit_of(standard_name, mapping.unit)) return;
  const auto names = unit_names(standard_name);
  throw InputError(fmt::format("unit = {}: not one of {}{}; give scale in {} per {}",
                               arm::shown(mapping.unit), fmt::join(names, ", "),
                               arm::did_you_mean(mapping.unit, names), si_unit_of(standard_name),
                               arm::shown(mapping.unit)));
}

ColumnMappings standard_mapping(const std::string& header) {
  const ColumnName name = split_column_name(header);
  if (name.unit.empty() || !header.ends_with(']')) return {};
  try {
    const std::string quantity = standard_name(name.base);
    if (!unit_of(quantity, name.unit) || is_doubtful_place(quantity)) return {};
    return {{quantity, {header, name.unit, 1.0}}};
  } catch (const InputError&) {
    return {};
  }
}

std::vector<std::size_t> places_used(const ColumnMappings& mappings,
                                     const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  for (const auto& [quantity, mapping] : mappings) {
    if (!mapping.expression.empty()) {
      try {
        std::ranges::copy(columns_in(mapping.expression, names), std::back_inserter(places));
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", quantity, error.what()));
      }
    } else if (const auto place = column_place(names, mapping.name)) {
      places.push_back(*place);
    } else {
      throw unknown_column(names, mapping.name);
    }
  }
  return places;
}

TimeRecord uneven_record_of(const ForeignTable& table, const ColumnMappings& mappings,
                            const std::string& file_name) {
  TimeRecord record;
  std::size_t row = 0;
  bool in_row = false;
  try {
    const auto sources = sources_of(table, mappings);
    in_row = true;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (!sources[i]) continue;
      add_quantity(record, sources[i]->quantity,
                   column_values(table, table.columns[i], *sources[i], row));
    }
    // The times first: rates are over them.
    const auto compute = [&](const auto& entry) {
      if (entry.second.expression.empty()) return;
      add_quantity(record, entry.first,
                   computed_values(table, {entry.first, entry.second}, record.time_s, row));
    };
    if (const auto time = mappings.find(std::string(kTime)); time != mappings.end()) compute(*time);
    for (const auto& entry : mappings) {
      if (entry.first != kTime) compute(entry);
    }
    in_row = false;
    for (const auto name : {kTime, kTorque}) {
      if ((name == kTime ? record.time_s : record.torque_N_m).empty()) {
        throw InputError(fmt::format("{}: no column assigned; columns: {}", name,
                                     shown_names(column_names(table.columns))));
      }
    }
    const std::size_t samples = record.time_s.size();
    bool even = record.torque_N_m.size() == samples;
    for (const auto& channel : record.channels) even = even && channel.values.size() == samples;
    if (!even) throw InputError("columns of different length");
    if (samples < 2) throw InputError("one sample; needs at least two");
  } catch (const InputError& error) {
    throw arm::located(error, file_name, in_row ? line_of(table, row) : 0);
  }
  return record;
}

Reference reference_of(const ForeignTable& table, const ColumnMapping& mapping,
                       const arm::Sensor& sensor, std::span<const double> times_s,
                       const std::string& file_name) {
  const Source source{arm::to_string(sensor), mapping, std::string(kReferenceColumn)};
  Reference reference{std::string(arm::unit(sensor)), {}};
  std::size_t row = 0;
  bool in_row = false;
  try {
    if (mapping.expression.empty()) {
      const ForeignColumn& column = table.columns[only_column(table, mapping.name)];
      in_row = true;
      reference.values = column_values(table, column, source, row);
    } else {
      in_row = true;
      reference.values = computed_values(table, source, times_s, row);
    }
    in_row = false;
    if (reference.values.size() != times_s.size()) {
      throw InputError(fmt::format("{}: {} values; the time has {}", kReferenceColumn,
                                   reference.values.size(), times_s.size()));
    }
  } catch (const InputError& error) {
    throw arm::located(error, file_name, in_row ? line_of(table, row) : 0);
  }
  return reference;
}

TimeRecord time_record_of(const ForeignTable& table, const ColumnMappings& mappings,
                          const std::string& file_name) {
  TimeRecord record = uneven_record_of(table, mappings, file_name);
  if (const auto fault = grid_fault(record.time_s)) {
    throw arm::located(fault->error, file_name, line_of(table, fault->sample));
  }
  return record;
}

}  // namespace flexarm::measured
