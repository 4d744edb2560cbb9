#include "measured/files/wrapped_angle.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::measured {

std::string unwrap(ForeignColumn& column, std::string_view unit, double scale) {
  constexpr double kRounding = 1e-3;
  constexpr double kLargestStep = 0.25;
  const auto known = unit.empty() ? std::nullopt : conversion_of("hub_angle", unit);
  const double turn = 2.0 * std::numbers::pi / known.value_or(std::abs(scale));
  std::vector<double> unwrapped = column.values;
  double least = 0.0;  // in turns, as all below
  double most = 0.0;
  double largest_step = 0.0;
  double largest_at_jump = 0.0;
  double turns = 0.0;
  std::size_t jumps = 0;
  std::size_t last = unwrapped.size();
  for (std::size_t k = 0; k < unwrapped.size(); ++k) {
    const double value = column.values[k] / turn;
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
    const double step = last < k ? value - column.values[last] / turn : 0.0;
    const double whole = std::round(step);
    // Behind missing samples the step may be large.
    if (last + 1 == k) {
      double& largest = whole == 0.0 ? largest_step : largest_at_jump;
      largest = std::max(largest, std::abs(step - whole));
      if (whole != 0.0) ++jumps;
    }
    last = k;
    turns -= whole;
    unwrapped[k] += turns * turn;
  }
  if (jumps == 0 || most - least > 1.0 + kRounding || largest_at_jump > kLargestStep) return "";
  const bool is_sure = largest_step <= kLargestStep && largest_at_jump <= 2.0 * largest_step &&
                       (least >= -kRounding || most <= 0.5 + kRounding);
  if (is_sure) column.values = std::move(unwrapped);
  return fmt::format(
      "{} jumps by a whole turn, {:.6g}, {} times from a sample to the next; {}",
      arm::shown(column.name), turn, jumps,
      is_sure ? "unwrapped" : "if it is recorded within one turn, unwrap it in the file");
}

}  // namespace flexarm::measured
