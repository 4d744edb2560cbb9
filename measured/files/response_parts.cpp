#include "arm/ascii.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/name_change.hpp"
#include "measured/files/response_columns.hpp"
#include "measured/files/response_unit.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

constexpr string_view kMagnitudeWords[] = {
    "mag",     "magn",   "magnitude",    "amplitude",      "ampl",   "amp",    "gain",     "abs",
    "modulus", "betrag", "verstaerkung", "amplitudengang", "module", "logmag", "magnitud", "mod"};
constexpr string_view kPhaseWords[] = {"phase", "phas",       "ph",           "arg", "argument",
                                       "phi",   "phasengang", "phasenwinkel", "pha"};
constexpr string_view kRealWords[] = {"re", "real", "realteil", "reel", "realpart", "reelle"};
constexpr string_view kImaginaryWords[] = {"im",         "imag",    "imaginary", "imaginaerteil",
                                           "imaginaire", "imagpart"};
constexpr string_view kCoherenceWords[] = {"coh", "coherence", "kohaerenz", "gamma"};
/// Words beside those of a part that tell nothing more.
constexpr string_view kFillers[] = {"part", "of", "log", "lin", "linear", "teil", "partie"};
constexpr string_view kSquareWords[] = {"squared", "quadrat", "sq"};
constexpr string_view kLagWords[] = {"lag", "lags", "lagging"};
constexpr string_view kInverseWords[] = {"inverse", "inv", "reciprocal", "kehrwert"};
constexpr string_view kConjugateWords[] = {"conj", "conjugate", "konjugiert", "conjugue"};
constexpr string_view kFrequencyWords[] = {"f",           "freq",     "freqs",     "frequency",
                                           "frequencies", "frequenz", "frequence", "hz",
                                           "hertz",       "xvalue"};
constexpr string_view kHertzWords[] = {"hz", "hertz"};
constexpr string_view kRadianWords[] = {
    "w", "wout", "omega", "angularfrequency", "kreisfrequenz", "pulsation"};

constexpr std::array<std::pair<ResponsePart, std::span<const string_view>>, 5> kParts = {{
    {ResponsePart::magnitude, kMagnitudeWords},
    {ResponsePart::phase, kPhaseWords},
    {ResponsePart::real, kRealWords},
    {ResponsePart::imaginary, kImaginaryWords},
    {ResponsePart::coherence, kCoherenceWords},
}};

bool is_among(std::span<const string_view> words, string_view word) {
  return std::ranges::count(words, word) > 0;
}

std::optional<ResponsePart> part_of_word(string_view word) {
  for (const auto& [part, words] : kParts) {
    if (is_among(words, word)) return part;
  }
  return std::nullopt;
}

/// A word of a name: `mag` and `H1` of `magH1`, `H1mag`, `H1_mag`; `mag` and `dB` of `magdB`.
struct NameWord {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string letters;  ///< plain, without digits
};

std::vector<NameWord> name_words(string_view name) {
  enum class Kind { other, lower, upper, digit };
  const auto kind_of = [](char c) {
    if (c >= 'a' && c <= 'z') return Kind::lower;
    if (c >= 'A' && c <= 'Z') return Kind::upper;
    if (arm::is_digit(c)) return Kind::digit;
    return arm::is_beyond_ascii(c) ? Kind::lower : Kind::other;
  };
  const auto is_decibel_at = [&](std::size_t i) {
    return name.substr(i).starts_with("dB") &&
           (i + 2 == name.size() || kind_of(name[i + 2]) != Kind::lower);
  };
  std::vector<NameWord> words;
  Kind before = Kind::other;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (is_decibel_at(i)) {
      words.push_back({i, i + 2, ""});
      before = Kind::upper;
      ++i;
      continue;
    }
    const Kind kind = kind_of(name[i]);
    const bool begins = before == Kind::other || (before == Kind::lower && kind == Kind::upper) ||
                        (before == Kind::digit && kind != Kind::digit);
    if (kind != Kind::other) {
      if (begins) words.push_back({i, i, ""});
      words.back().end = i + 1;
    }
    before = kind;
  }
  for (auto& word : words) {
    word.letters = plain_letters(name.substr(word.begin, word.end - word.begin));
  }
  return words;
}

/// The name without the words, and without marks around what is left. Digits behind a word tell
/// responses apart and stay: mag1, mag2.
std::string without(string_view name, const std::vector<NameWord>& words) {
  std::string rest;
  std::size_t at = 0;
  for (const auto& word : words) {
    std::size_t end = word.end;
    while (end > word.begin && arm::is_digit(name[end - 1])) --end;
    rest.append(name.substr(at, word.begin - at));
    if (!rest.ends_with(' ')) rest += ' ';
    at = end;
  }
  string_view left = name.substr(at);
  if (rest.ends_with(' ') && left.starts_with(' ')) left.remove_prefix(1);
  rest.append(left);
  constexpr string_view kMarks = " _-.,:;/()[]{}|<>";
  left = rest;
  while (!left.empty() && kMarks.find(left.front()) != string_view::npos) left.remove_prefix(1);
  while (!left.empty() && kMarks.find(left.back()) != string_view::npos) left.remove_suffix(1);
  return std::string(left);
}

/// Whether the text is the unit of a part or of a response.
bool is_part_unit(const std::string& unit) {
  return unit.empty() || is_canonical_unit(unit) || unit.starts_with("dB") ||
         !split_response_unit(unit).per.empty();
}

/// The name behind the structure that it is a field of.
string_view field_of(const ForeignTable& table, string_view name) {
  const auto point = name.rfind('.');
  const bool is_field =
      table.line_of_row.empty() && point != string_view::npos && point + 1 < name.size();
  return is_field ? name.substr(point + 1) : name;
}

/// The number or the sign that the name of a part has; functions and marks belong to the name of
/// the response: abs(H1), H1*.
std::optional<NameChange> change_of_part(string_view name) {
  auto change = change_in(name);
  const bool is_of_numbers =
      change && (change->kind == ChangeKind::factor || change->kind == ChangeKind::number ||
                 change->kind == ChangeKind::sign);
  if (!is_of_numbers) change.reset();
  return change;
}

std::string fault_of_change(const NameChange& change) {
  return fmt::format("its name has {}; write the numbers without it", change.mark);
}

/// Whether the name has a torque over a sensor, "Tau/Theta Magnitude".
bool is_input_over_output(string_view name, const std::vector<NameWord>& words) {
  const auto is_word_of = [](string_view letters, bool is_torque) {
    return std::ranges::any_of(quantity_words(), [&](const QuantityWords& entry) {
      return entry.quantity != "time" && (entry.quantity == "torque") == is_torque &&
             is_among(entry.words, letters);
    });
  };
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const string_view between = name.substr(words[i].end, words[i + 1].begin - words[i].end);
    if (between.find('/') != string_view::npos && is_word_of(words[i].letters, true) &&
        is_word_of(words[i + 1].letters, false)) {
      return true;
    }
  }
  return false;
}

/// The frequencies in a column that is called so and whose unit is one of frequencies or not told.
std::optional<PartColumn> frequencies_of(const ForeignTable& table, std::size_t place) {
  const ForeignColumn& column = table.columns[place];
  if (column.is_text()) return std::nullopt;
  const string_view field = field_of(table, column.name);
  const auto logarithm = logarithm_of_frequency(field);
  const ColumnName name = split_column_name(logarithm ? string_view(logarithm->of) : field);
  const auto change = change_of_part(name.base);
  const std::string letters = plain_letters(change ? change->rest : name.base);
  PartColumn part{ResponsePart::frequency, "", place, column.unit};
  if (logarithm && !is_canonical_unit(part.unit)) part.unit = name.unit;
  if (change) part.fault = fault_of_change(*change);
  if (is_among(kRadianWords, letters) && (part.unit.empty() || part.unit == "rad/s")) {
    part.is_unit_assumed = part.unit.empty();
    part.unit = "rad/s";
    return part;
  }
  if (!is_among(kFrequencyWords, letters)) return std::nullopt;
  if (part.unit.empty() && letters == "xvalue") return std::nullopt;
  if (part.unit.empty()) {
    part.is_unit_assumed = !is_among(kHertzWords, letters);
    part.unit = "Hz";
  }
  if (hertz_in_one(part.unit) == 0.0) return std::nullopt;
  return part;
}

/// Whether brackets name a response, H1 of Re(H1) and Im(H1): those of another column have the text
/// too, and it is no quotient of units.
bool names_response(const ForeignTable& table, const std::string& text) {
  if (is_stiffness_unit(text)) return false;
  const auto has_in_brackets = [&](const ForeignColumn& column) {
    const auto at = column.name.find(text);
    const auto end = at + text.size();
    return at != std::string::npos && at > 0 && end < column.name.size() &&
           string_view("([{|<").find(column.name[at - 1]) != string_view::npos &&
           string_view(")]}|>").find(column.name[end]) != string_view::npos;
  };
  return std::ranges::count_if(table.columns, has_in_brackets) > 1;
}

/// Why the numbers are not those of the part that the words name; empty: they are.
std::string fault_of(ResponsePart part, string_view name, const std::vector<NameWord>& words) {
  const auto has = [&](std::span<const string_view> faulty) {
    return std::ranges::any_of(
        words, [&](const NameWord& word) { return is_among(faulty, word.letters); });
  };
  const bool is_square = has(kSquareWords) || name.find("^2") != string_view::npos ||
                         name.find("\xc2\xb2") != string_view::npos;
  if (part == ResponsePart::magnitude && is_square) {
    return "a square; the magnitude itself must be there, absolute or in dB";
  }
  const bool is_logarithm =
      name.find("log10") != string_view::npos || name.find("Log10") != string_view::npos;
  if (part == ResponsePart::magnitude && is_logarithm) {
    return "a logarithm; the magnitude itself must be there, absolute or in dB";
  }
  if (part == ResponsePart::phase && has(kLagWords)) {
    return "a lag, whose sign is the other one; negate it, and call it phase";
  }
  if (has(kInverseWords) || is_input_over_output(name, words)) {
    return "an inverse of the response; write the response itself, of a sensor over a torque";
  }
  if (has(kConjugateWords)) {
    return "a conjugate, whose phase has the other sign; write the response itself";
  }
  const auto change = change_of_part(name);
  return change ? fault_of_change(*change) : "";
}

std::optional<PartColumn> part_of_column(const ForeignTable& table, std::size_t place) {
  const ForeignColumn& column = table.columns[place];
  if (column.is_text() || column.holds_nothing()) return std::nullopt;
  const string_view field = field_of(table, column.name);
  ColumnName name = split_column_name(field);
  std::string unit = column.unit;
  const bool is_hour = unit == "h";  // of Re(h)
  if ((!is_part_unit(unit) || is_hour) && unit == name.unit && names_response(table, unit)) {
    name.base = std::string(field);
    unit.clear();
  }
  if (name.base.size() > 2 && name.base.starts_with('|') && name.base.ends_with('|')) {
    return PartColumn{ResponsePart::magnitude, name.base.substr(1, name.base.size() - 2), place,
                      unit};
  }
  const auto words = name_words(name.base);
  std::vector<NameWord> taken;
  std::optional<ResponsePart> part;
  bool is_in_decibel = false;
  for (const auto& word : words) {
    const auto found = part_of_word(word.letters);
    // "Gain: Phase" is a phase.
    const bool is_phase_of_gain = part == ResponsePart::magnitude && found == ResponsePart::phase;
    if (found && (!part || is_phase_of_gain)) {
      part = found;
      taken.push_back(word);
    } else if (word.letters == "db") {
      is_in_decibel = true;
      taken.push_back(word);
    } else if (is_among(kFillers, word.letters) || is_among(kSquareWords, word.letters) ||
               is_among(kLagWords, word.letters)) {
      taken.push_back(word);
    }
  }
  // The angle of a complex number, not of a hub.
  if (!part && !words.empty() && words.front().letters == "angle" &&
      (words.size() == 1 || name.base.find('(') != std::string::npos)) {
    part = ResponsePart::phase;
    taken = {words.front()};
  }
  if (!part && is_in_decibel) part = ResponsePart::magnitude;
  if (!part) return std::nullopt;
  if (*part == ResponsePart::magnitude && is_in_decibel && !unit.starts_with("dB")) {
    unit = "dB " + unit;
  }
  return PartColumn{*part, without(name.base, taken),        place, unit,
                    false, fault_of(*part, name.base, words)};
}

}  // namespace

std::optional<LogarithmName> logarithm_of_frequency(string_view name) {
  constexpr std::array<std::pair<string_view, double>, 6> kLogarithms = {{{"log10", 10.0},
                                                                          {"Log10", 10.0},
                                                                          {"lg", 10.0},
                                                                          {"ln", std::numbers::e},
                                                                          {"log", 0.0},
                                                                          {"Log", 0.0}}};
  const auto found = std::ranges::find_if(
      kLogarithms, [&](const auto& entry) { return name.starts_with(entry.first); });
  if (found == kLogarithms.end()) return std::nullopt;
  string_view of = name.substr(found->first.size());
  while (of.starts_with(' ') || of.starts_with('_')) of.remove_prefix(1);
  if (of.starts_with('(')) {
    std::size_t end = 1;
    for (int depth = 1; end < of.size() && depth > 0; ++end) {
      depth += of[end] == '(' ? 1 : of[end] == ')' ? -1 : 0;
    }
    of = of.substr(1, end - 2);
  }
  const std::string letters = plain_letters(split_column_name(of).base);
  if (!is_among(kFrequencyWords, letters) && !is_among(kRadianWords, letters)) return std::nullopt;
  return LogarithmName{found->second, std::string(of)};
}

std::vector<PartColumn> response_parts(const ForeignTable& table) {
  std::vector<PartColumn> parts;
  for (std::size_t i = 0; i < table.columns.size() && parts.empty(); ++i) {
    if (auto frequencies = frequencies_of(table, i)) parts.push_back(std::move(*frequencies));
  }
  if (parts.empty()) return parts;
  const std::size_t lines = table.columns[parts.front().column].values.size();
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (i == parts.front().column || table.columns[i].values.size() != lines) continue;
    if (is_time_column(table.columns[i])) return {};
    if (auto part = part_of_column(table, i)) parts.push_back(std::move(*part));
  }
  return parts;
}

}  // namespace flexarm::measured
