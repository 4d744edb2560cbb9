#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::measured {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Date and time of day in a cell, or one of them.
struct TimeStamp {
  /// Days since 1970-01-01, of 1/3/2024 with the day first and with the month first; the same where
  /// the cell leaves no choice, empty for a date that there is not. Both empty without a date.
  std::optional<std::int64_t> day_first;
  std::optional<std::int64_t> month_first;
  /// Since midnight, or since the start where days stand in front of it, less the offset of the
  /// time zone where one is told; rounded to 1 ns.
  std::optional<std::int64_t> clock_ns;
  bool has_hours = true;  ///< false for minutes and seconds alone, 00:02.5
  bool has_zone = false;  ///< Z, UTC, GMT or an offset

  bool has_date() const { return day_first || month_first; }
};

/// Reads `12:00:00.002`, `2024-03-01T12:00:00.002Z`, `20240301T120000.002Z`,
/// `0 days 00:00:00.002` (time that passed), `2024/03/01 12:00:00,002`,
/// `01.03.2024 12:00:00`, `03/01/2024 12:00:00.002 PM`, `01-Mar-2024 12:00:00`, `02:31.5` (minutes
/// and seconds), `12:00:00:002`, and dates alone; time zones Z, UTC, GMT, +01:00, +0100. Empty for
/// any other text, a number among them.
std::optional<TimeStamp> parse_time_stamp(std::string_view cell);

/// Moment of a clock.
struct ClockStart {
  std::int64_t ns = 0;  ///< since 1970-01-01, or without a date as `TimeStamp::clock_ns`
  bool has_date = false;
  bool has_hours = true;  ///< as of `TimeStamp`
  bool has_zone = false;  ///< likewise
};

/// Times of stamps, and the moment that they count from.
struct StampedTimes {
  std::vector<double> seconds;  ///< since the first stamp, NaN where there is none
  ClockStart start;             ///< the first stamp
};

/// Times since the first stamp. Of dates that may have the day or the
/// month first, the reading with the shorter span is taken. A clock without dates that goes back by
/// more than half a day went past midnight (of minutes alone: by half an hour, past the hour).
///
/// `dates` complete stamps without one; they are empty, or as many.
StampedTimes stamped_times(std::span<const std::optional<TimeStamp>> stamps,
                           std::span<const std::optional<TimeStamp>> dates = {});

}  // namespace flexarm::measured
