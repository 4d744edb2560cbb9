#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/response_columns.hpp"
#include "measured/files/response_unit.hpp"
#include "measured/files/unit_spelling.hpp"

#include <algorithm>
#include <array>
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
constexpr string_view kFillers[] = {"part",   "of",   "log",    "lin",
                                    "linear", "teil", "partie", "squared"};
constexpr string_view kFrequencyWords[] = {"f",           "freq",     "freqs",     "frequency",
                                           "frequencies", "frequenz", "frequence", "hz",
                                           "hertz",       "xvalue"};
constexpr string_view kRadianWords[] = {"w", "omega", "angularfrequency", "kreisfrequenz",
                                        "pulsation"};

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

/// A word of a name: `mag` and `H1` of `magH1`, `H1mag`, `H1_mag`.
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
    if (c >= '0' && c <= '9') return Kind::digit;
    return static_cast<unsigned char>(c) >= 0x80U ? Kind::lower : Kind::other;
  };
  std::vector<NameWord> words;
  Kind before = Kind::other;
  for (std::size_t i = 0; i < name.size(); ++i) {
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
    while (end > word.begin && name[end - 1] >= '0' && name[end - 1] <= '9') --end;
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

bool is_frequency(string_view name, const std::string& unit, std::string& told) {
  const std::string letters = plain_letters(split_column_name(name).base);
  if (is_among(kRadianWords, letters) && (unit.empty() || unit == "rad/s")) {
    told = "rad/s";
    return true;
  }
  const bool is_named = is_among(kFrequencyWords, letters);
  const bool fits = unit == "Hz" || unit == "kHz" || unit == "rad/s" || unit == "rpm" ||
                    (unit.empty() && letters != "xvalue");
  told = unit.empty() ? "Hz" : unit;
  return is_named && fits;
}

std::optional<PartColumn> part_of_column(const ForeignTable& table, std::size_t place) {
  const ForeignColumn& column = table.columns[place];
  if (column.is_text() || column.holds_nothing()) return std::nullopt;
  const string_view field = field_of(table, column.name);
  ColumnName name = split_column_name(field);
  std::string unit = column.unit;
  if (!is_part_unit(unit)) {
    name.base = std::string(field);  // "Re(H1)" has no unit
    unit.clear();
  }
  if (name.base.size() > 2 && name.base.starts_with('|') && name.base.ends_with('|')) {
    return PartColumn{ResponsePart::magnitude, name.base.substr(1, name.base.size() - 2), place,
                      unit};
  }
  const auto words = name_words(name.base);
  std::vector<NameWord> taken;
  std::optional<ResponsePart> part;
  for (const auto& word : words) {
    const auto found = part_of_word(word.letters);
    if (found && !part) {
      part = found;
      taken.push_back(word);
    } else if (is_among(kFillers, word.letters)) {
      taken.push_back(word);
    }
  }
  // The angle of a complex number, not of a hub.
  if (!part && !words.empty() && words.front().letters == "angle" &&
      (words.size() == 1 || name.base.find('(') != std::string::npos)) {
    part = ResponsePart::phase;
    taken = {words.front()};
  }
  if (!part) return std::nullopt;
  return PartColumn{*part, without(name.base, taken), place, unit};
}

}  // namespace

std::vector<PartColumn> response_parts(const ForeignTable& table) {
  std::vector<PartColumn> parts;
  for (std::size_t i = 0; i < table.columns.size() && parts.empty(); ++i) {
    const ForeignColumn& column = table.columns[i];
    std::string unit;
    if (column.is_text() || !is_frequency(field_of(table, column.name), column.unit, unit))
      continue;
    parts.push_back({ResponsePart::frequency, "", i, unit});
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
