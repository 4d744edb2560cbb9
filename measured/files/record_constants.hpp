#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace flexarm::measured {

/// A number that a record does not have.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Instruments write 9.9E37 and 9.91E37 (SCPI) and greater numbers for what they could not measure.
inline constexpr double kOverRange = 9.9e37;

/// Standard names beside those of sensors.
inline constexpr std::string_view kTime = "time";
inline constexpr std::string_view kTorque = "torque";

/// Records are read whole.
inline constexpr std::size_t kLargestRecord_bytes = std::size_t{1} << 32U;

/// Columns of a table or signals of a file, which are compared with each other.
inline constexpr std::size_t kMostRecordColumns = 4096;

}  // namespace flexarm::measured
