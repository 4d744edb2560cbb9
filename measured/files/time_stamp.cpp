#include "measured/files/time_stamp.hpp"

#include "arm/ascii.hpp"
#include "arm/number.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/delimited_line.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;
using Days = std::optional<std::int64_t>;

constexpr std::int64_t kMinute_ns = 60 * kSecond_ns;
constexpr std::int64_t kHour_ns = 60 * kMinute_ns;
constexpr std::int64_t kDay_ns = 24 * kHour_ns;
constexpr std::size_t kLongestStamp = 64;

/// Takes a text apart from its front.
class StampText {
 public:
  explicit StampText(string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  string_view rest() const { return rest_; }
  char peek() const { return rest_.empty() ? '\0' : rest_.front(); }

  bool take(char c) {
    if (peek() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// One of the characters.
  bool take_any(string_view characters) {
    if (rest_.empty() || characters.find(rest_.front()) == string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void pass_blanks() { rest_ = trimmed(rest_); }

  template <class Is>
  string_view take_while(const Is& is) {
    std::size_t size = 0;
    while (size < rest_.size() && is(rest_[size])) ++size;
    const string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  string_view digits() { return take_while(arm::is_digit); }
  string_view letters() { return take_while(arm::is_letter); }

 private:
  string_view rest_;
};

int whole(string_view digits) {
  return arm::parse_number<int>(digits).value_or(-1);
}

/// 1 to 12 by an English, German or French name of a month; 0 for any other word.
int month_of(string_view word) {
  constexpr std::array<std::array<string_view, 3>, 12> kMonths = {{{"jan", "", ""},
                                                                   {"feb", "fev", ""},
                                                                   {"mar", "mae", "mrz"},
                                                                   {"apr", "avr", ""},
                                                                   {"may", "mai", ""},
                                                                   {"jun", "juin", ""},
                                                                   {"jul", "juil", ""},
                                                                   {"aug", "aou", ""},
                                                                   {"sep", "", ""},
                                                                   {"oct", "okt", ""},
                                                                   {"nov", "", ""},
                                                                   {"dec", "dez", ""}}};
  const std::string letters = plain_letters(word);
  for (std::size_t i = 0; i < kMonths.size(); ++i) {
    for (const auto name : kMonths[i]) {
      if (!name.empty() && letters.starts_with(name)) return static_cast<int>(i) + 1;
    }
  }
  return 0;
}

Days days_of(int year, int month, int day) {
  if (year < 0 || month < 1 || day < 1) return std::nullopt;
  constexpr int kCentury = 100;
  constexpr int kFirstOfTwoDigits = 70;  // 70 is 1970, 69 is 2069
  if (year < kCentury) year += year < kFirstOfTwoDigits ? 2000 : 1900;
  // Nanoseconds between these fit 64 bits.
  constexpr int kFirstYear = 1900;
  constexpr int kLastYear = 2150;
  if (year < kFirstYear || year > kLastYear) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// A date of three parts between - / . or blanks.
bool read_date(string_view text, TimeStamp& stamp) {
  StampText rest(text);
  std::array<string_view, 3> parts;
  std::size_t named = parts.size();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto is_of_name = [](char c) { return arm::is_letter(c) || arm::is_beyond_ascii(c); };
    parts[i] = rest.digits();
    if (parts[i].empty() && named == parts.size()) {
      parts[i] = rest.take_while(is_of_name);
      named = i;
      rest.take('.');
    }
    if (parts[i].empty()) return false;
    if (i + 1 == parts.size()) break;
    if (!rest.take_any("-/., ")) return false;
    rest.pass_blanks();
  }
  if (!rest.at_end()) return false;
  constexpr std::size_t kYearDigits = 4;
  const auto is_year = [](string_view part) { return part.size() == kYearDigits; };
  if (named < parts.size()) {  // 01-Mar-2024, Mar 1, 2024, 2024-Mar-01
    const int month = month_of(parts[named]);
    const string_view other = parts[named == 0 ? 1 : 0];
    const string_view last = parts[2];
    stamp.day_first = is_year(other) ? days_of(whole(other), month, whole(last))
                                     : days_of(whole(last), month, whole(other));
    stamp.month_first = stamp.day_first;
  } else if (is_year(parts[0])) {
    stamp.day_first = days_of(whole(parts[0]), whole(parts[1]), whole(parts[2]));
    stamp.month_first = stamp.day_first;
  } else {
    if (parts[0].size() > 2 || parts[1].size() > 2) return false;
    stamp.day_first = days_of(whole(parts[2]), whole(parts[1]), whole(parts[0]));
    stamp.month_first = text.find('.') == string_view::npos
                            ? days_of(whole(parts[2]), whole(parts[0]), whole(parts[1]))
                            : stamp.day_first;
  }
  return stamp.has_date();
}

/// The digits behind the mark of a fraction, in 1e-9.
std::int64_t billionths(string_view digits) {
  std::int64_t value = 0;
  constexpr std::size_t kDigits = 9;
  for (std::size_t i = 0; i < kDigits; ++i) {
    value = 10 * value + (i < digits.size() ? digits[i] - '0' : 0);
  }
  return value + (digits.size() > kDigits && digits[kDigits] >= '5' ? 1 : 0);
}

/// Reads the text behind the clock: AM or PM, then a time zone.
bool read_suffixes(StampText& rest, int& hours, std::int64_t& offset_ns, bool& has_zone) {
  rest.pass_blanks();
  for (int words = 0; words < 2 && arm::is_letter(rest.peek()); ++words) {
    std::string word = plain_letters(rest.letters());
    if (rest.take('.')) {  // a.m.
      word += plain_letters(rest.letters());
      rest.take('.');
    }
    constexpr int kNoon = 12;
    constexpr std::size_t kLongestZone = 4;
    if (word == "am" || word == "pm") {
      if (hours < 1 || hours > kNoon) return false;
      hours = hours % kNoon + (word == "pm" ? kNoon : 0);
    } else if (word.size() > kLongestZone || word.size() == 2) {
      return false;
    }
    has_zone = has_zone || word == "z" || word == "utc" || word == "gmt";
    rest.pass_blanks();
  }
  if (rest.peek() == '+' || rest.peek() == '-') {
    const std::int64_t sign = rest.take('+') ? 1 : -1;
    rest.take('-');
    string_view hour = rest.digits();
    string_view minute = "0";
    if (rest.take(':')) {
      minute = rest.digits();
    } else if (hour.size() == 4) {
      minute = hour.substr(2);
      hour = hour.substr(0, 2);
    }
    if (hour.empty() || minute.empty() || hour.size() > 2 || minute.size() > 2) return false;
    has_zone = true;
    offset_ns = sign * (whole(hour) * kHour_ns + whole(minute) * kMinute_ns);
  }
  return rest.at_end();
}

bool read_clock(string_view text, TimeStamp& stamp) {
  StampText rest(text);
  constexpr std::size_t kMostParts = 3;
  std::vector<int> parts;
  string_view fraction;
  do {
    const string_view digits = rest.digits();
    constexpr std::size_t kLongestPart = 4;  // hours that passed
    if (digits.empty() || digits.size() > (parts.empty() ? kLongestPart : 2)) return false;
    parts.push_back(whole(digits));
  } while (parts.size() < kMostParts && rest.take(':'));
  if (rest.take_any(".,")) {
    fraction = rest.digits();
    if (fraction.empty()) return false;
  } else if (rest.take(':')) {  // 12:00:00:002
    fraction = rest.digits();
    if (fraction.size() != 3 && fraction.size() != 6) return false;
  }
  // 12:30 may be hours and minutes, or minutes and seconds.
  if (parts.size() < 2 || (parts.size() == 2 && fraction.empty())) return false;
  stamp.has_hours = parts.size() == kMostParts;
  int hours = stamp.has_hours ? parts.front() : 0;
  const int minutes = parts[parts.size() - 2];
  const int seconds = parts.back();
  constexpr int kSixty = 60;
  if (seconds > kSixty || (stamp.has_hours && minutes >= kSixty)) return false;
  std::int64_t offset_ns = 0;
  if (!read_suffixes(rest, hours, offset_ns, stamp.has_zone)) return false;
  stamp.clock_ns = hours * kHour_ns + minutes * kMinute_ns + seconds * kSecond_ns +
                   billionths(fraction) - offset_ns;
  return true;
}

/// "2024-03-01T12:00:00.002Z" of "20240301T120000.002Z"; empty for any other text.
std::string long_form(string_view text) {
  constexpr std::size_t kDate = 8;
  constexpr std::size_t kClock = 15;
  if (text.size() < kClock || text[kDate] != 'T') return "";
  const auto is_digits = [](string_view part) { return std::ranges::all_of(part, arm::is_digit); };
  if (!is_digits(text.substr(0, kDate)) || !is_digits(text.substr(kDate + 1, kClock - kDate - 1))) {
    return "";
  }
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i == 4 || i == 6) out += '-';
    if (i == 11 || i == 13) out += ':';
    out += text[i];
  }
  return out;
}

/// The days in "3 days" or "1 day"; empty for any other text.
std::optional<std::int64_t> days_in(string_view text) {
  StampText rest(text);
  const string_view digits = rest.digits();
  constexpr std::size_t kLongest = 5;
  if (digits.empty() || digits.size() > kLongest) return std::nullopt;
  rest.pass_blanks();
  const string_view word = rest.letters();
  if ((word != "day" && word != "days") || !rest.at_end()) return std::nullopt;
  return whole(digits);
}

/// Stamps as nanoseconds, with the days that `days` reads of them.
template <class ReadDays>
std::vector<std::optional<std::int64_t>> nanoseconds_of(
    std::span<const std::optional<TimeStamp>> stamps,
    std::span<const std::optional<TimeStamp>> dates, const ReadDays& days) {
  std::vector<std::optional<std::int64_t>> times_ns;
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    const auto& stamp = stamps[k];
    const auto& date = dates.empty() ? stamp : dates[k];
    if (!stamp || !date || !stamp->clock_ns) {
      times_ns.emplace_back();
      continue;
    }
    const Days day = days(*date);
    const bool has_date = date->has_date();
    times_ns.push_back(has_date && !day
                           ? std::nullopt
                           : std::optional(day.value_or(0) * kDay_ns + *stamp->clock_ns));
  }
  return times_ns;
}

struct Span {
  std::size_t missing = 0;
  std::int64_t range_ns = 0;
  auto operator<=>(const Span&) const = default;
};

Span span_of(const std::vector<std::optional<std::int64_t>>& times_ns) {
  Span span;
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = std::numeric_limits<std::int64_t>::min();
  for (const auto& time_ns : times_ns) {
    if (!time_ns) {
      ++span.missing;
      continue;
    }
    first = std::min(first, *time_ns);
    last = std::max(last, *time_ns);
  }
  span.range_ns = first <= last ? last - first : 0;
  return span;
}

}  // namespace

std::optional<TimeStamp> parse_time_stamp(string_view cell) {
  string_view text = trimmed(cell);
  if (text.empty() || text.size() > kLongestStamp) return std::nullopt;
  const std::string long_text = long_form(text);
  if (!long_text.empty()) text = long_text;
  TimeStamp stamp;
  const std::size_t colon = text.find(':');
  if (colon == string_view::npos) {
    if (!read_date(text, stamp)) return std::nullopt;
    return stamp;
  }
  std::size_t begin = colon;
  while (begin > 0 && arm::is_digit(text[begin - 1])) --begin;
  string_view date = trimmed(text.substr(0, begin));
  if (date.ends_with('T') || date.ends_with('_') || date.ends_with(',')) date.remove_suffix(1);
  const auto days = days_in(trimmed(date));
  if (!days && !date.empty() && !read_date(trimmed(date), stamp)) return std::nullopt;
  if (!read_clock(text.substr(begin), stamp)) return std::nullopt;
  if (days) *stamp.clock_ns += *days * kDay_ns;
  return stamp;
}

StampedTimes stamped_times(std::span<const std::optional<TimeStamp>> stamps,
                           std::span<const std::optional<TimeStamp>> dates) {
  auto times_ns =
      nanoseconds_of(stamps, dates, [](const TimeStamp& date) { return date.day_first; });
  auto month_first =
      nanoseconds_of(stamps, dates, [](const TimeStamp& date) { return date.month_first; });
  if (span_of(month_first) < span_of(times_ns)) times_ns = std::move(month_first);
  const auto first =
      std::ranges::find_if(stamps, [](const auto& stamp) { return stamp.has_value(); });
  const bool has_dates = !dates.empty() || (first != stamps.end() && (*first)->has_date());
  const bool has_hours = first != stamps.end() && (*first)->has_hours;
  const std::int64_t turn_ns = has_hours ? kDay_ns : kHour_ns;
  StampedTimes times;
  std::optional<std::int64_t> start_ns;
  std::int64_t before_ns = 0;
  std::int64_t turns_ns = 0;
  for (const auto& time_ns : times_ns) {
    if (!time_ns) {
      times.seconds.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    if (!start_ns) start_ns = before_ns = *time_ns;
    if (!has_dates && *time_ns < before_ns - turn_ns / 2) turns_ns += turn_ns;
    before_ns = *time_ns;
    times.seconds.push_back(static_cast<double>(*time_ns + turns_ns - *start_ns) /
                            static_cast<double>(kSecond_ns));
  }
  const bool has_zone = first != stamps.end() && (*first)->has_zone;
  times.start = {start_ns.value_or(0), has_dates, has_hours, has_zone};
  return times;
}

}  // namespace flexarm::measured
