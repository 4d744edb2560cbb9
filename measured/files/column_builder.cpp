#include "measured/files/column_builder.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr double kBeyond = std::numeric_limits<double>::infinity();

/// The number and the known unit behind it, "0.002 sec" or "2ms".
std::optional<std::pair<double, std::string>> number_and_unit(string_view cell, char decimal) {
  constexpr std::size_t kLongest = 40;
  if (cell.size() > kLongest) return std::nullopt;
  for (std::size_t size = cell.size(); size > 0; --size) {
    const auto number = parse_cell(trimmed(cell.substr(0, size)), decimal);
    if (!number) continue;
    std::string unit = canonical_unit(trimmed(cell.substr(size)));
    if (unit.empty() || !is_canonical_unit(unit)) return std::nullopt;
    return std::pair{*number, std::move(unit)};
  }
  return std::nullopt;
}

}  // namespace

ColumnBuilder::ColumnBuilder(std::vector<ForeignColumn> columns, char decimal) : decimal_(decimal) {
  for (auto& column : columns) columns_.push_back({std::move(column)});
}

void ColumnBuilder::begin_texts(Column& column) const {
  column.kind = Kind::texts;
  column.column.texts.assign(line_of_row_.size(), column.first_stamp);
  column.column.values.clear();
  column.stamps.clear();
}

void ColumnBuilder::take_as_text(std::size_t column) {
  begin_texts(columns_[column]);
}

void ColumnBuilder::add_cell(Column& column, string_view cell) const {
  auto& values = column.column.values;
  if (column.kind == Kind::texts) {
    column.column.texts.emplace_back(cell);
  } else if (const auto value = parse_cell(cell, decimal_); value && column.kind != Kind::stamps) {
    values.push_back(*value);
    if (!std::isnan(*value)) column.kind = Kind::numbers;
  } else if (is_missing_number(cell)) {
    values.push_back(is_over_range_sign(cell) && column.kind != Kind::stamps ? kBeyond : kMissing);
    if (column.kind == Kind::stamps) column.stamps.emplace_back();
  } else if (const auto number = parse_complex_cell(cell, decimal_);
             number && column.kind != Kind::stamps) {
    column.kind = Kind::numbers;
    column.imaginary.resize(values.size(), 0.0);
    values.push_back(number->real());
    column.imaginary.push_back(number->imag());
  } else if (column.kind == Kind::numbers || has_thousands_separators(cell, decimal_)) {
    throw InputError(
        fmt::format("column {} = {}: {}", arm::shown(column.column.name), arm::shown(cell),
                    has_thousands_separators(cell, decimal_)
                        ? "has thousands separators; write the number without them"
                        : fmt::format("must be a number with a decimal {}, as in the rows above",
                                      decimal_ == ',' ? "comma" : "point")));
  } else if (auto stamp = parse_time_stamp(cell)) {
    if (column.kind == Kind::open) {
      column.kind = Kind::stamps;
      column.first_stamp = cell;
      column.stamps.resize(values.size());
    }
    values.push_back(kMissing);
    column.stamps.push_back(*stamp);
  } else {
    begin_texts(column);
    column.column.texts.emplace_back(cell);
  }
}

void ColumnBuilder::add_row(std::span<const string_view> cells, int line) {
  for (std::size_t i = 0; i < columns_.size(); ++i) add_cell(columns_[i], cells[i]);
  line_of_row_.push_back(line);
}

/// The only column of dates without a clock.
const ColumnBuilder::Column* ColumnBuilder::dates_for_clocks() const {
  const Column* found = nullptr;
  for (const auto& column : columns_) {
    const auto first =
        std::ranges::find_if(column.stamps, [](const auto& stamp) { return !!stamp; });
    if (first == column.stamps.end() || (*first)->clock_ns) continue;
    if (found != nullptr) return nullptr;
    found = &column;
  }
  return found;
}

void ColumnBuilder::convert_stamps() {
  const Column* dates = dates_for_clocks();
  for (auto& column : columns_) {
    if (column.kind != Kind::stamps || &column == dates) continue;
    const auto first =
        std::ranges::find_if(column.stamps, [](const auto& stamp) { return !!stamp; });
    const bool has_date = (*first)->has_date();
    if (!(*first)->clock_ns) {  // one of several columns of dates
      begin_texts(column);
      continue;
    }
    const bool is_completed = !has_date && dates != nullptr;
    StampedTimes times = is_completed ? stamped_times(column.stamps, dates->stamps)
                                      : stamped_times(column.stamps);
    column.column.values = std::move(times.seconds);
    column.column.start = times.start;
    column.column.unit = "s";
    column.column.is_stamp = true;
    assumptions_.push_back(fmt::format("{} is the time since {}{}", arm::shown(column.column.name),
                                       is_completed ? arm::shown(dates->first_stamp) + " " : "",
                                       arm::shown(column.first_stamp)));
  }
  for (auto& column : columns_) {
    if (&column == dates) begin_texts(column);
  }
}

void ColumnBuilder::take_unit_of_cells(Column& column) {
  if (column.kind != Kind::texts) return;
  std::string unit;
  std::vector<double> values;
  for (const string_view cell : column.column.texts) {
    if (is_missing_number(cell)) {
      values.push_back(is_over_range_sign(cell) ? kBeyond : kMissing);
      continue;
    }
    const auto measured = number_and_unit(cell, decimal_);
    if (!measured || (!unit.empty() && measured->second != unit)) return;
    values.push_back(measured->first);
    unit = measured->second;
  }
  if (unit.empty() || (!column.column.unit.empty() && column.column.unit != unit)) return;
  column.column.texts.clear();
  column.column.values = std::move(values);
  column.column.unit = unit;
  column.kind = Kind::numbers;
  assumptions_.push_back(
      fmt::format("cells of {} have the unit {}", arm::shown(column.column.name), unit));
}

void ColumnBuilder::find_stray(ForeignColumn& column) const {
  const auto is_text = [&](const std::string& cell) {
    return !is_missing_number(cell) && !parse_cell(cell, decimal_);
  };
  const auto& texts = column.texts;
  const auto first = std::ranges::find_if(texts, is_text);
  if (first == texts.end()) return;
  const bool is_alone = std::all_of(first, texts.end(), [&](const std::string& cell) {
    return cell == *first || !is_text(cell);
  });
  const bool has_numbers = std::ranges::any_of(
      texts, [&](const std::string& cell) { return parse_cell(cell, decimal_).has_value(); });
  if (!is_alone || !has_numbers) return;
  column.stray = *first;
  column.stray_row = static_cast<std::size_t>(first - texts.begin());
}

std::vector<ForeignColumn> ColumnBuilder::take_imaginary_parts() {
  std::vector<ForeignColumn> parts;
  for (auto& [column, kind, imaginary, stamps, first_stamp] : columns_) {
    const bool is_real = std::ranges::all_of(imaginary, [](double value) { return value == 0.0; });
    if (is_real) continue;
    imaginary.resize(column.values.size(), 0.0);
    const ColumnName name = split_column_name(column.name);
    const std::string base =
        name.unit.empty() ? name.base : fmt::format("{} [{}]", name.base, name.unit);
    column.path = std::exchange(column.name, "real part of " + base);
    parts.push_back({"imaginary part of " + base, column.unit, std::move(imaginary)});
    assumptions_.push_back(fmt::format("{} holds complex numbers: {}, {}", arm::shown(column.path),
                                       arm::shown(column.name), arm::shown(parts.back().name)));
  }
  return parts;
}

ForeignTable ColumnBuilder::finish() {
  convert_stamps();
  for (auto& column : columns_) {
    take_unit_of_cells(column);
    find_stray(column.column);
  }
  while (columns_.size() > 1 && columns_.back().kind == Kind::open &&
         columns_.back().column.name.starts_with("column ")) {
    columns_.pop_back();
  }
  auto imaginary = take_imaginary_parts();
  ForeignTable table;
  for (auto& column : columns_) table.columns.push_back(std::move(column.column));
  std::ranges::move(imaginary, std::back_inserter(table.columns));
  table.line_of_row = std::move(line_of_row_);
  table.assumptions = std::move(assumptions_);
  return table;
}

}  // namespace flexarm::measured
