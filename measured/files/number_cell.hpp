#pragma once

#include "arm/number.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace flexarm::measured {

/// The place of the D in a number as Fortran writes doubles, 1.8D-03: behind a decimal point and a
/// digit. npos where there is none.
inline std::size_t fortran_exponent(std::string_view cell) {
  const std::size_t at = cell.find_first_of("Dd");
  const std::size_t point = cell.find('.');
  return point < at && at >= 2 && at + 1 < cell.size() ? at : std::string_view::npos;
}

/// A cell of a table as a number: `arm::parse_number`, a leading + as other programs write it, and
/// exponents of Fortran, 1.8D-03.
template <class T>
std::optional<T> number_cell(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  const auto number = arm::parse_number<T>(cell);
  if constexpr (std::is_floating_point_v<T>) {
    constexpr std::size_t kLongest = 64;
    if (number || cell.size() > kLongest) return number;
    const std::size_t exponent = fortran_exponent(cell);
    if (exponent == std::string_view::npos) return number;
    std::array<char, kLongest> digits{};
    std::ranges::copy(cell, digits.begin());
    digits[exponent] = 'e';
    return arm::parse_number<T>({digits.data(), cell.size()});
  }
  return number;
}

}  // namespace flexarm::measured
