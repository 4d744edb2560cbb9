#include "measured/files/name_change.hpp"

#include "arm/ascii.hpp"
#include "arm/number.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/unit_spelling.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

/// Signs that change a quantity wherever they stand in its name, in UTF-8.
constexpr std::array<std::pair<string_view, ChangeKind>, 11> kChangingSigns = {{
    {"\xcc\x87", ChangeKind::derivative},      // combining dot above
    {"\xcb\x99", ChangeKind::derivative},      // dot above
    {"\xe2\x80\xb2", ChangeKind::derivative},  // prime
    {"\xe2\x80\xb3", ChangeKind::function},    // double prime
    {"\xce\x94", ChangeKind::function},        // Delta
    {"\xe2\x88\x86", ChangeKind::function},    // increment
    {"\xe2\x88\x82", ChangeKind::function},    // partial differential
    {"\xe2\x88\x87", ChangeKind::function},    // nabla
    {"\xe2\x88\x91", ChangeKind::function},    // sum
    {"\xe2\x88\x9a", ChangeKind::function},    // root
    {"\xe2\x88\xab", ChangeKind::function},    // integral
}};
constexpr string_view kTwoDots = "\xcc\x88";  // combining; an umlaut on any letter but a Greek one

constexpr std::array<string_view, 5> kMinuses = {"(-1)*", "(-1)", "(-)", "-", "\xe2\x80\x93"};

constexpr string_view kFunctions[] = {"abs",  "sqrt", "sin",    "cos",  "tan", "exp",
                                      "log",  "ln",   "int",    "rms",  "std", "max",
                                      "mean", "min",  "cumsum", "diff", "sign"};

/// Symbols of which a point behind them is a derivative, and no sign of a shortened word.
constexpr string_view kSymbols[] = {"theta", "omega", "tau"};

bool begins_with_name(string_view text) {
  return !text.empty() && (arm::is_letter(text.front()) || arm::is_beyond_ascii(text.front()) ||
                           text.front() == '(' || text.front() == '|');
}

/// The end of the number at `begin`, "100", "0.01", "1e-3", "-3"; `begin` without one.
std::size_t number_end(string_view text, std::size_t begin) {
  constexpr std::size_t kLongest = 24;
  const string_view may_be = text.substr(begin, kLongest);
  std::size_t size = std::min(may_be.find_first_not_of("0123456789.+-eE"), may_be.size());
  while (size > 0 && !arm::parse_number<double>(may_be.substr(0, size))) --size;
  return begin + size;
}

/// Whether an x multiplies: it stands alone.
bool is_times(string_view text, std::size_t at) {
  if (text[at] == '*') return true;
  const bool is_x = text[at] == 'x' || text[at] == 'X';
  return is_x && (at == 0 || !arm::is_letter(text[at - 1])) &&
         (at + 1 == text.size() || !arm::is_letter(text[at + 1]));
}

std::size_t first_behind_blanks(string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(' ', at), text.size());
}

/// The name without what stands from `begin` to `end`.
NameChange without_mark(ChangeKind kind, const std::string& text, std::size_t begin,
                        std::size_t end) {
  return {kind, text.substr(begin, end - begin),
          std::string(trimmed(text.substr(0, begin) + text.substr(end)))};
}

std::optional<NameChange> sign_in(string_view text) {
  for (const string_view minus : kMinuses) {
    if (!text.starts_with(minus)) continue;
    const string_view rest = trimmed(text.substr(minus.size()));
    if (begins_with_name(rest))
      return NameChange{ChangeKind::sign, std::string(minus), std::string(rest)};
  }
  return std::nullopt;
}

/// "|tau|", "abs(tau)".
std::optional<NameChange> function_in(string_view text) {
  if (text.size() > 2 && text.front() == '|' && text.find('|', 1) != string_view::npos) {
    return NameChange{ChangeKind::function, "|",
                      std::string(text.substr(1, text.find('|', 1) - 1))};
  }
  const auto open = text.find('(');
  if (open == string_view::npos) return std::nullopt;
  const std::string word = plain_letters(text.substr(0, open));
  if (std::ranges::count(kFunctions, string_view(word)) == 0) return std::nullopt;
  const auto close = std::min(text.rfind(')'), text.size());
  if (close < open) return std::nullopt;
  return NameChange{ChangeKind::function, word,
                    std::string(text.substr(open + 1, close - open - 1))};
}

/// "d(theta)/dt", "dtheta/dt", "d/dt theta".
std::optional<NameChange> quotient_in(string_view text) {
  const auto at = text.find("/dt");
  if (!text.starts_with('d') || at == string_view::npos) return std::nullopt;
  if (at + 3 < text.size() && arm::is_letter(text[at + 3])) return std::nullopt;
  string_view rest = trimmed(at == 1 ? text.substr(4) : text.substr(1, at - 1));
  if (rest.starts_with('(') && rest.ends_with(')')) rest = rest.substr(1, rest.size() - 2);
  const bool is_once = text.find('^') == string_view::npos;
  return NameChange{is_once ? ChangeKind::derivative : ChangeKind::function, "d/dt",
                    std::string(rest)};
}

/// "1/tau", "180-theta".
std::optional<NameChange> number_in_front(const std::string& text) {
  const std::size_t end = number_end(text, 0);
  const std::size_t sign = first_behind_blanks(text, end);
  if (end == 0 || sign == text.size()) return std::nullopt;
  if (string_view("+-/").find(text[sign]) == string_view::npos) return std::nullopt;
  if (!begins_with_name(string_view(text).substr(first_behind_blanks(text, sign + 1))))
    return std::nullopt;
  return without_mark(ChangeKind::number, text, 0, sign + 1);
}

/// "theta+90", "Magnitude (dB) - 20"; a date, a range and "Torque-1" have none.
std::optional<NameChange> number_behind(const std::string& text) {
  const auto sign = text.find_last_of("+-");
  if (sign == std::string::npos || sign == 0) return std::nullopt;
  const std::string number = text.substr(first_behind_blanks(text, sign + 1));
  if (number.empty() || !arm::is_digit(number.front()) || number_end(number, 0) != number.size()) {
    return std::nullopt;
  }
  const auto last = text.find_last_not_of(' ', sign - 1);
  if (last == std::string::npos) return std::nullopt;
  if (text[sign] == '-') {
    const bool is_index = number.size() == 1 || (number[0] == '0' && arm::is_digit(number[1]));
    const auto digits = text.find_last_not_of("0123456789", last);
    const bool is_range =
        arm::is_digit(text[last]) && (digits == std::string::npos || !arm::is_letter(text[digits]));
    if (is_index || is_range) return std::nullopt;
  }
  const bool is_behind_name = arm::is_letter(text[last]) || arm::is_digit(text[last]) ||
                              arm::is_beyond_ascii(text[last]) || text[last] == ')' ||
                              text[last] == ']';
  const bool is_exponent = last + 1 == sign && last > 0 &&
                           (text[last] == 'e' || text[last] == 'E') &&
                           arm::is_digit(text[last - 1]);
  if (!is_behind_name || is_exponent) return std::nullopt;
  return without_mark(ChangeKind::number, text, sign, text.size());
}

/// Marks behind a symbol, dots above it, and signs of mathematics.
std::optional<NameChange> mark_in(const std::string& text) {
  for (const auto& [sign, kind] : kChangingSigns) {
    const auto at = text.find(sign);
    if (at == std::string::npos) continue;
    NameChange change = without_mark(kind, text, at, at + sign.size());
    if (const auto next = change.rest.find(sign); next != std::string::npos) {  // two dots
      change = {ChangeKind::function, change.mark, change.rest.erase(next, sign.size())};
    }
    return change;
  }
  const auto dots = text.find(kTwoDots);
  if (dots != std::string::npos && dots >= 2 &&
      (text[dots - 2] == '\xce' || text[dots - 2] == '\xcf')) {
    return without_mark(ChangeKind::function, text, dots, dots + kTwoDots.size());
  }
  const auto ends_in = [&](string_view mark, ChangeKind kind) -> std::optional<NameChange> {
    if (text.size() <= mark.size() || !text.ends_with(mark) || text.starts_with(mark)) {
      return std::nullopt;
    }
    return without_mark(kind, text, text.size() - mark.size(), text.size());
  };
  for (const string_view prime : {"'", "\xe2\x80\x99"}) {
    if (text.starts_with(prime)) continue;  // a quote
    const std::string twice = std::string(prime) + std::string(prime);
    if (auto change = ends_in(twice, ChangeKind::function)) return change;
    if (auto change = ends_in(prime, ChangeKind::derivative)) return change;
  }
  if (auto change = ends_in("*", ChangeKind::reference)) return change;
  if (std::ranges::count(kSymbols, string_view(plain_letters(text))) == 0) return std::nullopt;
  if (auto change = ends_in("..", ChangeKind::function)) return change;
  return ends_in(".", ChangeKind::derivative);
}

}  // namespace

std::optional<NameChange> factor_in(string_view name) {
  const std::string text = in_plain_signs(name);
  const std::size_t in_front = number_end(text, 0);
  const std::size_t sign = first_behind_blanks(text, in_front);
  if (in_front > 0 && sign < text.size() && is_times(text, sign)) {
    return without_mark(ChangeKind::factor, text, 0, sign + 1);
  }
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_divided = text[at] == '/' && at > 0 && !arm::is_digit(text[at - 1]);  // no 1/2
    if (!is_divided && text[at] != '^' && !is_times(text, at)) continue;
    const std::size_t begin = first_behind_blanks(text, at + 1);
    const std::size_t end = number_end(text, begin);
    constexpr string_view kBehind = " )]},_";
    const bool ends = end == text.size() || kBehind.find(text[end]) != string_view::npos;
    const auto number = arm::parse_number<double>(string_view(text).substr(begin, end - begin));
    if (ends && number && *number != 0.0 && *number != 1.0) {
      return without_mark(ChangeKind::factor, text, at, end);
    }
  }
  return std::nullopt;
}

std::optional<NameChange> change_in(string_view name) {
  if (auto factor = factor_in(name)) return factor;
  const std::string text = in_plain_signs(trimmed(name));
  if (auto change = sign_in(text)) return change;
  if (auto change = function_in(text)) return change;
  if (auto change = quotient_in(text)) return change;
  if (auto change = number_in_front(text)) return change;
  if (auto change = number_behind(text)) return change;
  return mark_in(text);
}

}  // namespace flexarm::measured
