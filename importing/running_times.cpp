#include "importing/running_times.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_mapping.hpp"
#include "measured/files/time_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::importing {

void require_running(const std::vector<double>& times_s, const measured::ForeignTable& table) {
  std::size_t falls = 0;
  std::size_t first = 0;
  for (std::size_t k = 1; k < times_s.size(); ++k) {
    if (times_s[k] >= times_s[k - 1]) continue;
    if (falls++ == 0) first = k;
  }
  if (2 * falls > times_s.size()) {
    throw arm::InputError(fmt::format(
        "time falls from {} s to {} s in {} {}, and in {} of {} rows; write the rows in the order "
        "of their times",
        times_s[first - 1], times_s[first], table.line_of_row.empty() ? "row" : "line",
        table.line_of_row.empty() ? static_cast<int>(first) + 1 : line_of(table, first), falls,
        times_s.size()));
  }
  const bool are_equal = times_s.size() > 1 && std::ranges::count(times_s, times_s.front()) ==
                                                   std::ranges::ssize(times_s);
  if (!are_equal) return;
  throw arm::InputError(fmt::format(
      "time = {} s in all {} rows; write it with more digits, take another column with --column "
      "time=NAME, or state the sampling period with --period",
      times_s.front(), times_s.size()));
}

std::vector<std::string> second_clocks(const measured::ForeignTable& table,
                                       const std::vector<double>& times_s,
                                       const std::vector<std::string>& not_used) {
  std::vector<std::string> sentences;
  if (times_s.size() < 2) return sentences;
  for (const auto& column : table.columns) {
    const auto unit = measured::unit_of("time", column.unit.empty() ? "s" : column.unit);
    if (!unit || column.values.size() != times_s.size() ||
        std::ranges::count(not_used, column.name) == 0 || column.is_stamp ||
        !measured::is_time_column(column)) {
      continue;
    }
    double most_s = 0.0;
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      most_s = std::max(most_s, std::abs(unit->to_si(column.values[k]) - times_s[k]));
    }
    // Beyond the record it counts from another moment.
    const double length_s = times_s.back() - times_s.front();
    const double period_s = length_s / static_cast<double>(times_s.size() - 1);
    if (!(most_s > measured::kMostJitter_periods * period_s && most_s < length_s)) continue;
    sentences.push_back(fmt::format(
        "{} is a second time, up to {:.4g} s off the one that is used; if signals were sampled at "
        "it, write it with them to a file of its own and import both with --join",
        arm::shown(column.name), most_s));
  }
  return sentences;
}

}  // namespace flexarm::importing
