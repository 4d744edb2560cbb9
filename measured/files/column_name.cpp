#include "measured/files/column_name.hpp"

#include "arm/number.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/unit_spelling.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

constexpr std::array<std::pair<char, char>, 3> kBrackets = {{{'[', ']'}, {'(', ')'}, {'{', '}'}}};

/// The place of the bracket that the last one closes; npos without one.
std::size_t opening_bracket(string_view text, char open, char close) {
  int depth = 0;
  for (std::size_t at = text.size(); at > 0; --at) {
    if (text[at - 1] == close) ++depth;
    if (text[at - 1] == open && --depth == 0) return at - 1;
  }
  return string_view::npos;
}

/// What stands in the pair of brackets that `text` ends with, and what stands in front of it.
bool split_at_brackets(string_view text, string_view& front, string_view& inside) {
  for (const auto& [open, close] : kBrackets) {
    if (!text.ends_with(close)) continue;
    const auto begin = opening_bracket(text, open, close);
    if (begin == string_view::npos) continue;
    front = trimmed(text.substr(0, begin));
    inside = trimmed(text.substr(begin + 1, text.size() - begin - 2));
    return true;
  }
  return false;
}

/// "(:,1)", "(1)" or "[3]" is an index of the name in front, and no unit. [1] is the unit of a
/// strain.
bool is_index(string_view text, string_view inside) {
  const bool is_strain = inside == "1" && text.ends_with(']');
  return !is_strain && !inside.empty() &&
         inside.find_first_not_of("0123456789:, ") == string_view::npos;
}

/// The unit in "ms", "Theta in rad" or "deg, filtered"; what stands there if none is known.
std::string unit_in_brackets(string_view inside) {
  if (std::string unit = find_unit(inside); !unit.empty()) return unit;
  std::string found;
  if (const auto in = inside.rfind(" in "); in != string_view::npos) {
    found = find_unit(inside.substr(in + 4));
    if (!found.empty() && !factor_in(inside.substr(0, in))) return found;
  }
  for (string_view rest = inside; !rest.empty();) {
    const auto end = std::min(rest.find_first_of(",;:"), rest.size());
    const string_view part = rest.substr(0, end);
    const std::string unit = find_unit(part);
    if (unit.empty() && factor_in(part)) return std::string(trimmed(inside));
    if (found.empty()) found = unit;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return found.empty() ? std::string(trimmed(inside)) : found;
}

/// "theta" of "theta in" and "theta_in", in front of a unit.
string_view without_in(string_view base) {
  for (const string_view in : {" in", "_in"}) {
    if (base.size() > in.size() && base.ends_with(in)) base.remove_suffix(in.size());
  }
  return trimmed(base);
}

/// The end of the number at `begin`, "100", "0.01", "1e-3", "-3"; `begin` without one.
std::size_t number_end(string_view text, std::size_t begin) {
  constexpr std::size_t kLongest = 24;
  const string_view may_be = text.substr(begin, kLongest);
  std::size_t size = std::min(may_be.find_first_not_of("0123456789.+-eE"), may_be.size());
  while (size > 0 && !arm::parse_number<double>(may_be.substr(0, size))) --size;
  return begin + size;
}

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Whether an x multiplies: it stands alone.
bool is_times(string_view text, std::size_t at) {
  if (text[at] == '*') return true;
  const bool is_x = text[at] == 'x' || text[at] == 'X';
  return is_x && (at == 0 || !is_name_letter(text[at - 1])) &&
         (at + 1 == text.size() || !is_name_letter(text[at + 1]));
}

}  // namespace

std::string canonical_unit(string_view unit) {
  string_view text = trimmed(unit);
  string_view front;
  string_view inside;
  if (split_at_brackets(text, front, inside) && front.empty()) text = inside;
  std::string known = find_unit(text);
  return known.empty() ? std::string(text) : known;
}

ColumnName split_column_name(string_view header) {
  const string_view text = trimmed(header);
  string_view front;
  string_view inside;
  if (split_at_brackets(text, front, inside) && !front.empty()) {
    if (is_index(text, inside)) return {std::string(text), ""};
    return {std::string(front), unit_in_brackets(inside)};
  }
  if (const auto slash = text.find(" / "); slash != string_view::npos) {
    return {std::string(trimmed(text.substr(0, slash))), canonical_unit(text.substr(slash + 3))};
  }
  for (const char mark : {'/', ','}) {  // "t/s", "Time, s"
    const auto at = text.find(mark);
    if (at == string_view::npos || at == 0) continue;
    std::string unit = find_unit(text.substr(at + 1));
    if (!unit.empty()) return {std::string(trimmed(text.substr(0, at))), std::move(unit)};
  }
  // The longest tail that may be a unit first: "tip_acc_m_s2" ends in m_s2, not in s2. "torque_min"
  // is the smallest.
  const std::size_t first = std::max(text.size(), kLongestUnit + 2) - kLongestUnit - 1;
  for (auto at = text.find_first_of("_ ", first); at != string_view::npos;
       at = text.find_first_of("_ ", at + 1)) {
    std::string unit = find_unit(text.substr(at + 1));
    if (unit.empty() || unit == "1" || unit == "min") continue;
    return {std::string(without_in(text.substr(0, at))), std::move(unit)};
  }
  return {std::string(text), ""};
}

std::optional<NameFactor> factor_in(string_view name) {
  const std::string text = in_plain_signs(name);
  const auto behind_blanks = [&](std::size_t at) {
    return std::min(text.find_first_not_of(' ', at), text.size());
  };
  const auto between = [&](std::size_t begin, std::size_t end) {
    return NameFactor{text.substr(begin, end - begin),
                      std::string(trimmed(text.substr(0, begin) + text.substr(end)))};
  };
  const std::size_t in_front = number_end(text, 0);
  const std::size_t sign = behind_blanks(in_front);
  if (in_front > 0 && sign < text.size() && is_times(text, sign)) return between(0, sign + 1);
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_divided =
        text[at] == '/' && at > 0 && (text[at - 1] < '0' || text[at - 1] > '9');  // no 1/2
    if (!is_divided && text[at] != '^' && !is_times(text, at)) continue;
    const std::size_t begin = behind_blanks(at + 1);
    const std::size_t end = number_end(text, begin);
    constexpr string_view kBehind = " )]},_";
    const bool ends = end == text.size() || kBehind.find(text[end]) != string_view::npos;
    const auto number = arm::parse_number<double>(string_view(text).substr(begin, end - begin));
    if (ends && number && *number != 0.0 && *number != 1.0) return between(at, end);
  }
  return std::nullopt;
}

}  // namespace flexarm::measured
