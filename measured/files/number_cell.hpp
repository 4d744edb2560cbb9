#pragma once

#include "arm/number.hpp"

#include <optional>
#include <string_view>

namespace flexarm::measured {

/// A cell of a table as a number: `arm::parse_number`, and a leading + as other programs write it.
template <class T>
std::optional<T> number_cell(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  return arm::parse_number<T>(cell);
}

}  // namespace flexarm::measured
