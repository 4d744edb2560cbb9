#include "measured/files/json_times.hpp"

#include "measured/files/response_columns.hpp"
#include "measured/files/sampling_settings.hpp"
#include "measured/files/text_lines.hpp"
#include "measured/files/universal_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::measured {

void add_json_times(ForeignTable& table, std::span<const JsonNumber> numbers,
                    std::span<const KeyedUnit> units, std::vector<std::string>& left_out) {
  const bool is_of_responses = response_parts(table).size() > 1;
  if (table.columns.empty() || is_of_responses ||
      std::ranges::any_of(table.columns, is_time_column)) {
    return;
  }
  SamplingSettings settings;
  std::vector<std::string> used;
  for (const auto& number : numbers) {
    // A date and its clock are no time in s.
    if (number.text.find_first_of(":\t") != std::string::npos) continue;
    const auto unit = std::ranges::find(units, number.key, &KeyedUnit::key);
    const std::string text =
        fmt::format("{}: {} {}", number.key, number.text, unit == units.end() ? "" : unit->text);
    const TextLine line{1, text};
    const SamplingSettings own = sampling_settings(std::span(&line, 1), '\t', '.');
    if (!own.period_s && !is_start_name(number.key)) continue;
    used.push_back(number.left_out);
    if (!own.period_s) {
      settings.start_s = own.start_s;
      continue;
    }
    constexpr double kAlike = 1e-6;
    if (settings.period_s && std::abs(*own.period_s / *settings.period_s - 1.0) > kAlike) {
      table.assumptions.push_back(
          fmt::format("sampling periods of {} s and {} s are told; state one with --period",
                      *settings.period_s, *own.period_s));
      return;
    }
    if (!settings.period_s) settings.period_s = own.period_s;
  }
  if (!settings.period_s) return;
  std::size_t rows = 0;
  for (const auto& column : table.columns) rows = std::max(rows, column.values.size());
  table.assumptions.push_back(
      fmt::format("times begin at {} s and are {} s apart", settings.start_s, *settings.period_s));
  table.columns.push_back(
      {"time [s]", "s", grid_points({settings.start_s, *settings.period_s}, rows)});
  table.columns.back().is_made = true;
  std::erase_if(left_out,
                [&](const std::string& phrase) { return std::ranges::count(used, phrase) > 0; });
}

}  // namespace flexarm::measured
