#include "measured/files/missing_signs.hpp"

#include "arm/input_error.hpp"
#include "measured/files/record_constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace flexarm::measured {

std::string take_out_over_range(ForeignColumn& column, const std::string& what) {
  std::size_t count = 0;
  double first = 0.0;
  for (double& value : column.values) {
    if (!is_over_range(value) && !std::isinf(value)) continue;
    if (count++ == 0) first = value;
    value = kUnknown;
  }
  if (count == 0) return "";
  return fmt::format(
      "{}: {} cell{} of column {} with {:g}, an instrument's sign of no measurement; taken as "
      "empty",
      what, count, count == 1 ? "" : "s", arm::shown(column.name), first);
}

std::vector<std::string> doubtful_signs(std::span<const double> values, const std::string& name,
                                        const std::string& what) {
  constexpr double kSigns[] = {
      -999.0,   999.0,   -9999.0, 9999.0,     -99999.0,  99999.0,       -999999.0,    999999.0,
      -32768.0, 32767.0, 65535.0, -8388608.0, 8388607.0, -2147483648.0, 2147483647.0, 4294967295.0,
      -1e20,    1e20,    -1e30,   1e30,       -1e37,     1e37};
  std::vector<std::string> doubts;
  for (const double sign : kSigns) {
    const auto count = std::ranges::count(values, sign);
    if (count == 0) continue;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const double value : values) {
      if (!is_reading(value) || std::abs(value) == std::abs(sign)) continue;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    if (lowest > highest) continue;
    const double distance = std::max(lowest - sign, sign - highest);
    if (!(distance > highest - lowest)) continue;
    doubts.push_back(
        fmt::format("{}: {} cell{} of column {} {} {:.10g}, the others lie from {:.6g} to {:.6g}; "
                    "if {:.10g} stands for a missing sample, empty {}",
                    what, count, count == 1 ? "" : "s", arm::shown(name), count == 1 ? "is" : "are",
                    sign, lowest, highest, sign, count == 1 ? "this cell" : "these cells"));
  }
  return doubts;
}

}  // namespace flexarm::measured
