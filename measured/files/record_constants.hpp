#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

namespace flexarm::measured {

/// A number that a record does not have.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Whether this stands for what an instrument could not measure: 9.9E37, 9.91E37
/// (SCPI), 9.99999E37, in single precision too; the largest number in single or double precision,
/// in six digits too.
inline constexpr bool is_over_range(double value) {
  const double size = value < 0.0 ? -value : value;
  return (size >= 9.89999e37 && size <= 1.00001e38) || (size >= 3.40282e38 && size <= 3.40283e38) ||
         (size >= 1.79769e308 && size <= std::numeric_limits<double>::max());
}

/// Whether it is a finite number that was measured.
inline bool is_reading(double value) {
  return std::isfinite(value) && !is_over_range(value);
}

/// Standard names beside those of sensors.
inline constexpr std::string_view kTime = "time";
inline constexpr std::string_view kTorque = "torque";

/// Records are read whole.
inline constexpr std::size_t kLargestRecord_bytes = std::size_t{1} << 32U;

/// Columns of a table or signals of a file, which are compared with each other.
inline constexpr std::size_t kMostRecordColumns = 4096;

}  // namespace flexarm::measured
