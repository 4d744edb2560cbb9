#pragma once

#include "arm/input_error.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// The names of columns or of their labels.
template <class Columns>
std::vector<std::string> column_names(const Columns& columns) {
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.name);
  return names;
}

/// "time, torque": names as they may stand in a line.
std::string shown_names(std::span<const std::string> names);

/// The number in "#3", counted from 1; empty for any other text.
std::optional<std::size_t> column_number(std::string_view typed);

/// The place, from 0, of the column that `typed` stands for among the names of a file's columns:
/// the first one of that name; else the n-th for "#n" or "n"; else the only one that has this name
/// without its unit, as "Moment" has of "Moment (N m)". Empty when there is none.
std::optional<std::size_t> column_place(std::span<const std::string> names, std::string_view typed);

/// "column NAME: not in the file (did you mean ...?); it has ...".
arm::InputError unknown_column(std::span<const std::string> names, std::string_view typed);

}  // namespace flexarm::measured
