#include "measured/files/record_range.hpp"

#include "arm/decimal_comma.hpp"
#include "arm/input_error.hpp"
#include "arm/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

namespace {

using arm::InputError;

/// A bound; empty leaves `value` as it is.
void read_bound(std::string_view text, bool by_rows, double& value) {
  if (text.empty()) return;
  const auto number = arm::parse_number<double>(text);
  const bool is_row = number && *number >= 1.0 && *number == std::floor(*number);
  if (!number || !std::isfinite(*number) || (by_rows && !is_row)) {
    throw InputError(fmt::format("{}: must be {}{}", arm::shown(text),
                                 by_rows ? "a row, a whole number from 1" : "a time in s",
                                 arm::decimal_comma_hint(text)));
  }
  value = *number;
}

}  // namespace

RecordRange parse_range(std::string_view text, bool by_rows) {
  const auto colon = text.find(':');
  if (colon == std::string_view::npos || text.size() == 1) {
    throw InputError(fmt::format("{}: must be FROM:TO, FROM: or :TO", arm::shown(text)));
  }
  RecordRange range;
  range.by_rows = by_rows;
  read_bound(text.substr(0, colon), by_rows, range.from);
  read_bound(text.substr(colon + 1), by_rows, range.to);
  if (range.to <= range.from) {
    throw InputError(fmt::format("{}: must end after its beginning", arm::shown(text)));
  }
  return range;
}

TimeRecord samples_of(const TimeRecord& record, std::size_t first, std::size_t last) {
  const auto part = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first),
                               values.begin() + static_cast<std::ptrdiff_t>(last));
  };
  TimeRecord samples{part(record.time_s), part(record.torque_N_m), {}};
  for (const auto& channel : record.channels) {
    samples.channels.push_back({channel.sensor, part(channel.values)});
    for (const std::size_t sample : channel.left_out) {
      if (sample < first || sample >= last) continue;
      samples.channels.back().left_out.push_back(sample - first);
    }
  }
  samples.reference.unit = record.reference.unit;
  if (!record.reference.values.empty()) samples.reference.values = part(record.reference.values);
  return samples;
}

TimeRecord part_of(const TimeRecord& record, const RecordRange& range, std::size_t& first,
                   std::span<const std::size_t> rows) {
  const std::size_t samples = record.time_s.size();
  const auto is_in = [&](std::size_t k) {
    const std::size_t row = rows.empty() ? k : rows[k];
    const double at = range.by_rows ? static_cast<double>(row + 1) : record.time_s[k];
    return at >= range.from && at <= range.to;
  };
  first = 0;
  while (first < samples && !is_in(first)) ++first;
  std::size_t last = samples;
  while (last > first && !is_in(last - 1)) --last;
  if (last < first + 2) {
    const auto [earliest, latest] = std::ranges::minmax(record.time_s);
    throw InputError(
        fmt::format("{} sample{} in this range; the file has rows 1 to {}, times {} "
                    "s to {} s",
                    last - first, last - first == 1 ? "" : "s",
                    rows.empty() ? samples : rows.back() + 1, earliest, latest));
  }
  return samples_of(record, first, last);
}

}  // namespace flexarm::measured
