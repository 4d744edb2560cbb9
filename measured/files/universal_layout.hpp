#pragma once

#include "measured/files/universal_file.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// How the numbers of a data set 58 are laid out, told by its record 7.
struct UniversalLayout {
  bool is_complex = false;
  bool is_double = true;
  bool is_even = true;

  /// Numbers a point: abscissa where uneven, real part, imaginary part.
  std::size_t numbers() const { return (is_even ? 1U : 2U) + (is_complex ? 1U : 0U); }
  /// Whether the k-th number of a point is its abscissa.
  bool is_abscissa(std::size_t k) const { return !is_even && k == 0; }
  std::size_t bytes() const { return is_double ? 8U : 4U; }
  /// Columns of the k-th number of a point: E20.12, or E13.5.
  int width(std::size_t k) const { return is_double && !is_abscissa(k) ? 20 : 13; }
  /// Points that make a line of text are numbers of this count.
  std::size_t numbers_a_line() const {
    if (!is_double) return 6;
    return !is_even && is_complex ? 3U : 4U;
  }
};

/// The last ID line of data sets that hold what the digits of others leave.
inline constexpr std::string_view kRemainderMark = "FLEXARM REMAINDER: ADD TO THE DATA SET ABOVE";
inline constexpr std::string_view kAbscissaMark = "FLEXARM ABSCISSA OF THE DATA SET ABOVE";

/// Puts what `format_universal_file` set apart back where it belongs.
std::vector<UniversalFunction> joined(std::vector<UniversalFunction> functions);

}  // namespace flexarm::measured
