#include "importing/unit_contradictions.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_expression.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace flexarm::importing {

namespace {

using measured::ColumnLabel;
using measured::ColumnMapping;

/// Whether a number or pi stands in an expression, besides the names of its columns.
bool has_number(std::string_view expression) {
  const auto is_of_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
  };
  for (std::size_t at = 0; at < expression.size();) {
    if (expression[at] == '[') {
      at = std::min(expression.find(']', at), expression.size() - 1) + 1;
      continue;
    }
    std::size_t end = at;
    while (end < expression.size() && is_of_name(expression[end])) ++end;
    const std::string_view word = expression.substr(at, end - at);
    const bool begins_with_digit =
        !word.empty() && std::isdigit(static_cast<unsigned char>(word.front())) != 0;
    if (word == "pi" || begins_with_digit) return true;
    at = std::max(end, at + 1);
  }
  return false;
}

bool contradicts(const std::string& quantity, const ColumnMapping& mapping,
                 const std::string& told) {
  if (told.empty() || told == "1" || told == mapping.unit || !measured::is_canonical_unit(told)) {
    return false;
  }
  if (measured::is_unit_of(quantity, told)) {
    return !mapping.is_scale_stated || mapping.unit != measured::si_unit_of(quantity);
  }
  return !measured::is_unit_of(quantity, mapping.unit) || !mapping.is_scale_stated;
}

/// Whether an expression without numbers gives another unit than its mapping has.
bool is_unlike(const std::string& quantity, const ColumnMapping& mapping, const std::string& told) {
  const bool is_rate = mapping.expression.find("ddt(") != std::string::npos;
  const auto own = measured::conversion_of(quantity, is_rate ? told + "/s" : told);
  return !told.empty() && own && own != measured::conversion_of(quantity, mapping.unit);
}

}  // namespace

std::vector<std::string> unit_contradictions(const measured::ColumnMappings& mappings,
                                             std::span<const ColumnLabel> columns) {
  const std::vector<std::string> names = measured::column_names(columns);
  std::vector<std::string> sentences;
  const auto add = [&](const std::string& quantity, const ColumnMapping& mapping,
                       const ColumnLabel& column) {
    sentences.push_back(fmt::format("{}: the file tells {} of {}, but it is read in {}, as stated",
                                    quantity, column.unit, arm::shown(column.name), mapping.unit));
  };
  for (const auto& [quantity, mapping] : mappings) {
    if (mapping.expression.empty()) {
      const auto place = measured::column_place(columns, mapping.name);
      if (place && contradicts(quantity, mapping, columns[*place].unit)) {
        add(quantity, mapping, columns[*place]);
      }
    } else if (!has_number(mapping.expression)) {
      for (const auto place : measured::columns_in(mapping.expression, names)) {
        if (is_unlike(quantity, mapping, columns[place].unit)) {
          add(quantity, mapping, columns[place]);
        }
      }
    }
  }
  return sentences;
}

}  // namespace flexarm::importing
