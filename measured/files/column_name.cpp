#include "measured/files/column_name.hpp"

#include "measured/files/delimited_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using std::string_view;

struct Spellings {
  const char* unit;
  std::vector<string_view>
      others;  ///< without blanks, in lower case where that tells no units apart
};

/// Units with an m of two meanings (mN m and MN m, ms and Ms) are told by their case.
const std::vector<Spellings>& vocabulary() {
  static const std::vector<Spellings> units = {
      {"s", {"sec", "secs", "second", "seconds"}},
      {"ms", {"msec", "millisecond", "milliseconds"}},
      {"us", {"usec", "\xc2\xb5s", "\xce\xbcs", "microsecond", "microseconds"}},
      {"N m", {"Nm", "N*m", "N.m", "N-m", "N\xc2\xb7m", "N\xe2\x8b\x85m", "N_m"}},
      {"N mm", {"Nmm", "N*mm", "N-mm", "mNm", "mN*m", "mN-m", "N\xc2\xb7mm", "mN\xc2\xb7m"}},
      {"rad", {"radian", "radians"}},
      {"deg", {"degree", "degrees", "\xc2\xb0", "\xc2\xba"}},
      {"rad/s", {"rad_s", "rad_per_s", "rad/sec", "rad*s^-1"}},
      {"deg/s", {"deg_s", "deg_per_s", "dps", "deg/sec", "\xc2\xb0/s", "\xc2\xba/s"}},
      {"m/s^2",
       {"m/s2", "m/s\xc2\xb2", "m_s2", "m_per_s2", "ms-2", "mps2", "m/s/s", "m/s**2", "m/sec^2"}},
      {"g", {"gn", "gee"}},
      {"m", {"meter", "meters", "metre", "metres"}},
      {"mm", {"millimeter", "millimetre"}},
      {"1", {"-", "dimensionless"}},
      {"ustrain",
       {"ue", "microstrain", "\xc2\xb5strain", "\xc2\xb5m/m", "\xce\xbcm/m", "um/m",
        "\xc2\xb5\xce\xb5", "\xce\xbc\xce\xb5"}},
      {"V", {"volt", "volts"}},
      {"mV", {}},
      {"A", {"amp", "amps", "ampere"}},
      {"mA", {}},
      {"N", {}},
      {"Hz", {}},
      {"rpm", {"rev/min", "1/min"}},
      {"counts", {"count", "cts", "ticks"}},
      {"%", {"percent"}},
  };
  return units;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Without blanks, and in lower case where `fold`.
std::string plain(string_view text, bool fold) {
  std::string out;
  for (const char c : text) {
    if (c != ' ') out += fold ? lower(c) : c;
  }
  return out;
}

constexpr std::array<std::pair<char, char>, 3> kBrackets = {{{'[', ']'}, {'(', ')'}, {'{', '}'}}};

/// What stands in the pair of brackets that `text` ends with, and what stands in front of it.
bool split_at_brackets(string_view text, string_view& front, string_view& inside) {
  for (const auto& [open, close] : kBrackets) {
    const auto begin = text.rfind(open);
    if (!text.ends_with(close) || begin == string_view::npos) continue;
    front = trimmed(text.substr(0, begin));
    inside = trimmed(text.substr(begin + 1, text.size() - begin - 2));
    return true;
  }
  return false;
}

const char* find_unit(string_view text) {
  for (const bool fold : {false, true}) {
    const std::string typed = plain(text, fold);
    for (const auto& entry : vocabulary()) {
      // A capital tells S (siemens), G (gauss) or M apart: units of one letter are not folded.
      if (fold && typed.size() == 1) continue;
      if (typed == plain(entry.unit, fold)) return entry.unit;
      if (std::ranges::count(entry.others, string_view(typed)) > 0) return entry.unit;
    }
  }
  return nullptr;
}

}  // namespace

std::string canonical_unit(string_view unit) {
  string_view text = trimmed(unit);
  string_view front;
  string_view inside;
  if (split_at_brackets(text, front, inside) && front.empty()) text = inside;
  const char* known = find_unit(text);
  return known != nullptr ? std::string(known) : std::string(text);
}

bool is_known_unit(string_view canonical) {
  return std::ranges::any_of(vocabulary(),
                             [&](const Spellings& entry) { return canonical == entry.unit; });
}

ColumnName split_column_name(string_view header) {
  const string_view text = trimmed(header);
  string_view front;
  string_view inside;
  if (split_at_brackets(text, front, inside) && !front.empty()) {
    return {std::string(front), canonical_unit(inside)};
  }
  if (const auto slash = text.find(" / "); slash != string_view::npos) {
    return {std::string(trimmed(text.substr(0, slash))), canonical_unit(text.substr(slash + 3))};
  }
  for (const char mark : {'/', ','}) {  // "t/s", "Time, s"
    const auto at = text.find(mark);
    if (at == string_view::npos || at == 0) continue;
    const char* unit = find_unit(trimmed(text.substr(at + 1)));
    if (unit != nullptr) return {std::string(trimmed(text.substr(0, at))), unit};
  }
  // The longest tail first: "tip_acc_m_s2" ends in m_s2, not in s2.
  for (auto at = text.find_first_of("_ ", 1); at != string_view::npos;
       at = text.find_first_of("_ ", at + 1)) {
    const char* unit = find_unit(text.substr(at + 1));
    if (unit != nullptr && string_view(unit) != "1") return {std::string(text.substr(0, at)), unit};
  }
  return {std::string(text), ""};
}

}  // namespace flexarm::measured
