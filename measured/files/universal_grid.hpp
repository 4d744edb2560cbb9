#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::measured {

/// An even abscissa as a universal file has it: `first` and `step` in 6 digits.
struct UniversalGrid {
  double first = 0.0;
  double step = 0.0;
};

/// The points first + k step, k from 0, each the double nearest to the decimal sum. A step that is
/// 1/n in 6 digits for one whole n and no other, but not in all digits, is taken for 1/n:
/// 1.66667E-03 is 600 Hz, 1.52588E-05 is 65536 Hz.
std::vector<double> grid_points(const UniversalGrid& grid, std::size_t count);

/// The double nearest to `value` in the 6 digits of a field E13.5.
double in_six_digits(double value);

/// `value` in FORTRAN's form Ew.d: a digit, a point, `decimals` digits and an exponent of two
/// digits or more, right-aligned in `width` columns.
std::string fortran_number(double value, int width, int decimals);

}  // namespace flexarm::measured
