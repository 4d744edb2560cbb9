#include "measured/files/split_seconds.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using std::string_view;

constexpr std::array<string_view, 10> kMilli = {
    "ms",          "msec",         "msecs",        "millis",        "milli",
    "millisecond", "milliseconds", "millisekunde", "millisekunden", "millisecondes"};
constexpr std::array<string_view, 9> kMicro = {"us",           "usec",         "usecs",
                                               "micros",       "micro",        "microsecond",
                                               "microseconds", "mikrosekunde", "mikrosekunden"};

bool is_word_for(const ForeignColumn& column, std::span<const string_view> words) {
  const ColumnName name = split_column_name(column.name);
  return std::ranges::count(words, plain_letters(column.name)) > 0 ||
         std::ranges::count(words, plain_letters(name.base)) > 0;
}

bool is_part(const ForeignColumn& column) {
  return is_word_for(column, kMilli) || is_word_for(column, kMicro);
}

bool is_of_whole_seconds(const ForeignColumn& column) {
  const bool is_in_s = column.is_stamp || column.unit == "s" || column.unit.empty();
  return is_in_s && is_time_column(column) && !is_part(column) && !column.holds_nothing() &&
         (!column.start || column.start->ns % kSecond_ns == 0) &&
         std::ranges::all_of(column.values, [](double time) {
           return std::isnan(time) || (std::isfinite(time) && time == std::round(time));
         });
}

/// Whether the part counts on while seconds change, as the time since the start does.
bool counts_on(const std::vector<double>& seconds, const std::vector<double>& part) {
  bool do_repeat = false;
  bool do_change = false;
  for (std::size_t k = 1; k < part.size(); ++k) {
    if (part[k] < part[k - 1]) return false;
    (seconds[k] == seconds[k - 1] ? do_repeat : do_change) = true;
  }
  return do_repeat && do_change;
}

}  // namespace

void complete_whole_seconds(ForeignTable& table) {
  auto& columns = table.columns;
  if (std::ranges::count_if(columns, is_of_whole_seconds) != 1) return;
  const auto time = std::ranges::find_if(columns, is_of_whole_seconds);
  const auto place = static_cast<std::size_t>(time - columns.begin());
  std::vector<double> made = columns[place].values;
  double digit_s = 1.0;
  std::vector<std::string> used;
  for (const auto& [words, unit_s] :
       {std::pair{std::span<const string_view>(kMilli), 1e-3}, {kMicro, 1e-6}}) {
    const auto is_such = [&](const ForeignColumn& column) { return is_word_for(column, words); };
    const auto part = std::ranges::find_if(columns, is_such);
    const bool fits =
        std::ranges::count_if(columns, is_such) == 1 && part->values.size() == made.size() &&
        !part->holds_nothing() &&
        std::ranges::all_of(part->values,
                            [&](double value) {
                              return std::isnan(value) ||
                                     (value >= 0.0 && value * unit_s < digit_s * (1.0 - 1e-9));
                            }) &&
        !counts_on(made, part->values);
    if (!fits) continue;
    for (std::size_t k = 0; k < made.size(); ++k) {
      // Divided by a whole number: 0.002, not 2 times the double next to 0.001.
      made[k] += part->values[k] / std::round(1.0 / unit_s);
    }
    digit_s = unit_s;
    used.push_back(part->name);
  }
  if (used.empty()) return;
  columns[place].values = std::move(made);
  for (const auto& name : used) {
    table.assumptions.push_back(fmt::format("{} is of whole seconds, completed by column {}",
                                            arm::shown(columns[place].name), arm::shown(name)));
  }
  std::erase_if(columns, [&](const ForeignColumn& column) {
    return std::ranges::count(used, column.name) > 0 && is_part(column);
  });
}

}  // namespace flexarm::measured
