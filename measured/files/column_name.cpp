#include "measured/files/column_name.hpp"

#include "measured/files/delimited_line.hpp"
#include "measured/files/name_change.hpp"
#include "measured/files/unit_spelling.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

/// Units that end names as words or indices more often: "torque_min", "tau_h", "force_ft".
constexpr std::array<string_view, 8> kNoTails = {"1", "min", "h", "ft", "mil", "uN", "cN", "daN"};

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
    if (unit.empty() || std::ranges::count(kNoTails, string_view(unit)) > 0) continue;
    if (text.substr(at + 1) == "in") continue;  // "torque_in" goes in
    return {std::string(without_in(text.substr(0, at))), std::move(unit)};
  }
  return {std::string(text), ""};
}

}  // namespace flexarm::measured
