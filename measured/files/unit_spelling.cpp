#include "measured/files/unit_spelling.hpp"

#include "arm/ascii.hpp"
#include "measured/files/delimited_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using std::string_view;

/// A unit of one word; the others in lower case, unless case tells units apart.
struct UnitWord {
  const char* unit;
  std::vector<string_view> others;
};

const std::vector<UnitWord>& unit_words() {
  static const std::vector<UnitWord> words = {
      {"s",
       {"sec", "secs", "second", "seconds", "sek", "sekunde", "sekunden", "seconde", "secondes"}},
      {"ms",
       {"msec", "msecs", "millisec", "millisecond", "milliseconds", "millis", "millisekunde",
        "millisekunden", "milliseconde", "millisecondes"}},
      {"us", {"usec", "usecs", "microsec", "microsecond", "microseconds", "micros"}},
      {"ns", {"nsec", "nanosecond", "nanoseconds", "nanos"}},
      {"min", {"minute", "minutes", "minuten"}},
      {"h", {"hr", "hrs", "hour", "hours", "stunde", "stunden"}},
      {"m", {"meter", "meters", "metre", "metres"}},
      {"mm", {"millimeter", "millimeters", "millimetre", "millimetres"}},
      {"cm", {"centimeter", "centimeters", "centimetre", "centimetres"}},
      {"um", {"micron", "microns", "micrometer", "micrometers", "micrometre", "micrometres"}},
      {"inch", {"in", "inches"}},
      {"ft", {"foot", "feet"}},
      {"mil", {"mils"}},
      {"rad", {"rads", "radian", "radians"}},
      {"mrad", {"mrads", "milliradian", "milliradians"}},
      {"urad", {"urads", "microradian", "microradians"}},
      {"mdeg", {"millidegree", "millidegrees"}},
      {"deg", {"degs", "degree", "degrees", "grad", "degre", "degres"}},
      {"rev",
       {"revs", "revolution", "revolutions", "turn", "turns", "umdrehung", "umdrehungen", "umdr",
        "tour", "tours", "tr"}},
      {"rpm", {}},
      {"krpm", {}},
      {"g", {"gn", "gee"}},
      {"mg", {}},
      {"N", {"newton", "newtons"}},
      {"uN", {"micronewton", "micronewtons"}},
      {"mN", {"millinewton", "millinewtons"}},
      {"cN", {}},
      {"daN", {}},
      {"kN", {"kilonewton", "kilonewtons"}},
      {"MN", {"meganewton", "meganewtons"}},
      {"1", {"dimensionless"}},
      {"ustrain", {"ue", "ustrains", "microstrain", "microstrains", "ppm"}},
      {"mstrain", {"millistrain", "m\xce\xb5", "\xe2\x80\xb0"}},
      {"V", {"volt", "volts"}},
      {"mV", {"millivolt", "millivolts"}},
      {"A", {"amp", "amps", "ampere", "amperes"}},
      {"mA", {"milliamp", "milliamps", "milliampere", "milliamperes"}},
      {"Hz", {"hertz"}},
      {"kHz", {"kilohertz"}},
      {"counts", {"count", "cts", "ticks", "tick", "lsb"}},
      {"%", {"percent"}},
      {"dB", {"decibel", "decibels"}},
  };
  return words;
}

/// Units of several words by their factors, and spellings that are no words between separators.
struct CompoundUnit {
  const char* unit;
  std::vector<std::map<string_view, int>> factors;
  std::vector<string_view> others;
};

const std::vector<CompoundUnit>& compound_units() {
  static const std::vector<CompoundUnit> units = {
      {"N m", {{{"N", 1}, {"m", 1}}}, {"Nm", "newtonmeter", "newtonmeters"}},
      {"N mm", {{{"N", 1}, {"mm", 1}}, {{"mN", 1}, {"m", 1}}}, {"Nmm", "mNm"}},
      {"N cm", {{{"N", 1}, {"cm", 1}}}, {"Ncm"}},
      {"kN m", {{{"kN", 1}, {"m", 1}}}, {"kNm"}},
      {"MN m", {{{"MN", 1}, {"m", 1}}}, {"MNm"}},
      {"uN m", {{{"uN", 1}, {"m", 1}}}, {"uNm"}},
      {"cN m", {{{"cN", 1}, {"m", 1}}}, {"cNm"}},
      {"daN m", {{{"daN", 1}, {"m", 1}}}, {"daNm"}},
      {"gf cm", {}, {"gfcm", "gf*cm", "gf-cm", "gf.cm", "gcm", "g*cm", "g-cm", "g.cm"}},
      {"kgf cm", {}, {"kgfcm", "kgf*cm", "kgf-cm", "kgf.cm", "kgcm", "kg*cm", "kg-cm", "kg.cm"}},
      {"lbf in",
       {},
       {"lbfin", "lbf*in", "lbf-in", "lbf.in", "lbin", "lb*in", "lb-in", "in-lb", "in-lbf", "in*lb",
        "in*lbf", "in.lbf", "inlb", "inlbf"}},
      {"lbf ft",
       {},
       {"lbfft", "lbf*ft", "lbf-ft", "lbf.ft", "lbft", "lb*ft", "lb-ft", "ft-lb", "ft-lbf", "ft*lb",
        "ft*lbf", "ft.lbf", "ftlb", "ftlbf"}},
      {"ozf in",
       {},
       {"ozfin", "ozf*in", "ozf-in", "ozf.in", "ozin", "oz*in", "oz-in", "in-oz", "in*oz", "in-ozf",
        "in*ozf", "inoz", "inozf"}},
      {"rad/s", {{{"rad", 1}, {"s", -1}}}, {"rad_s", "rads_s", "rads-1", "rads^-1"}},
      {"mrad/s", {{{"mrad", 1}, {"s", -1}}}, {"mrad_s"}},
      {"deg/s", {{{"deg", 1}, {"s", -1}}}, {"deg_s", "degs_s", "dps"}},
      {"rad/min", {{{"rad", 1}, {"min", -1}}}, {"rad_min"}},
      {"rev/s", {{{"rev", 1}, {"s", -1}}}, {"rps", "rev_s"}},
      {"rpm", {{{"rev", 1}, {"min", -1}}}, {"1/min", "min-1", "min^-1", "rev_min", "u/min"}},
      {"m/s^2", {{{"m", 1}, {"s", -2}}}, {"m_s2", "ms-2", "ms^-2", "mps2"}},
      {"mm/s^2", {{{"mm", 1}, {"s", -2}}}, {"mm_s2"}},
      {"cm/s^2", {{{"cm", 1}, {"s", -2}}}, {"cm_s2"}},
      {"in/s^2", {{{"inch", 1}, {"s", -2}}}, {}},
      {"ft/s^2", {{{"ft", 1}, {"s", -2}}}, {}},
      {"m/s", {{{"m", 1}, {"s", -1}}}, {"m_s", "mps"}},
      {"mm/s", {{{"mm", 1}, {"s", -1}}}, {"mm_s"}},
      {"ustrain", {{{"um", 1}, {"m", -1}}}, {"um_m", "uin/in"}},
      {"mstrain", {{{"mm", 1}, {"m", -1}}}, {"mm_m"}},
      {"1", {}, {"-", "m/m", "mm/mm", "in/in", "\xce\xb5"}},
  };
  return units;
}

/// What is written with signs beyond ASCII, and with other words, in one way.
constexpr std::array<std::pair<string_view, string_view>, 20> kSigns = {{
    {"\xc2\xb5\xce\xb5", "ue"},       // micro sign, epsilon
    {"\xce\xbc\xce\xb5", "ue"},       // mu, epsilon
    {"\xc2\xb5", "u"},                // micro sign
    {"\xce\xbc", "u"},                // mu
    {"\xc2\xb0", "deg"},              // degree sign
    {"\xc2\xba", "deg"},              // ordinal indicator
    {"\xc3\xa9", "e"},                // of "degrés"
    {"\xc2\xb7", "*"},                // middle dot
    {"\xe2\x8b\x85", "*"},            // dot operator
    {"\xc3\x97", "*"},                // multiplication sign
    {"\xe2\x88\x97", "*"},            // asterisk operator
    {"\xc2\xb2", "^2"},               // superscript 2
    {"\xe2\x81\xbb\xc2\xb9", "^-1"},  // superscript minus, 1
    {"\xe2\x81\xbb\xc2\xb2", "^-2"},  // superscript minus, 2
    {"\xe2\x81\xbb\x31", "^-1"},      // superscript minus before a plain digit
    {"\xe2\x88\x92", "-"},            // minus sign
    {"\xe2\x88\x95", "/"},            // division slash
    {"**", "^"},
    {" per ", "/"},
    {"_per_", "/"},
}};

std::string without_blanks(string_view text) {
  std::string out;
  std::ranges::copy_if(text, std::back_inserter(out), [](char c) { return !is_blank(c); });
  return out;
}

/// Units by their spellings without blanks.
using Spellings = std::map<std::string, string_view, std::less<>>;

/// Of two units that are spelled alike the first stands.
template <class Units>
Spellings spellings_of(const Units& units, bool in_lower) {
  Spellings spellings;
  for (const auto& unit : units) {
    const auto add = [&](string_view spelling) {
      spellings.emplace(in_lower ? in_lower_case(spelling) : std::string(spelling), unit.unit);
    };
    add(without_blanks(unit.unit));
    std::ranges::for_each(unit.others, add);
  }
  return spellings;
}

struct SpelledUnits {
  Spellings words;
  Spellings compounds;
};

SpelledUnits spelled_units(bool in_lower) {
  return {spellings_of(unit_words(), in_lower), spellings_of(compound_units(), in_lower)};
}

string_view find_in(const Spellings& spellings, string_view typed) {
  const auto found = spellings.find(typed);
  return found == spellings.end() ? string_view{} : found->second;
}

/// Whether a word of the text is a symbol behind a capital M, which is mega and not folded to
/// milli. MS and MV stand in headers that are all in capitals.
bool has_mega(string_view text) {
  constexpr std::array<string_view, 9> kMegaSymbols = {"N", "NM", "Nm",     "rad", "s",
                                                       "m", "g",  "strain", "deg"};
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin;
    while (end < text.size() && arm::is_letter(text[end])) ++end;
    const string_view word = text.substr(begin, end - begin);
    if (word.starts_with('M') && std::ranges::count(kMegaSymbols, word.substr(1)) > 0) return true;
    begin = std::max(end, begin + 1);
  }
  return false;
}

/// Words between separators, with their powers.
class FactorReader {
 public:
  FactorReader(string_view text, const Spellings& words) : text_(text), words_(words) {}

  std::optional<std::map<string_view, int>> read() {
    std::map<string_view, int> factors;
    int sign = 1;
    while (true) {
      skip_blanks();
      const std::size_t begin = at_;
      while (at_ < text_.size() && arm::is_letter(text_[at_])) ++at_;
      const string_view word = find_in(words_, text_.substr(begin, at_ - begin));
      if (word.empty() || word == "1") return std::nullopt;
      const auto power = read_power();
      if (!power) return std::nullopt;
      factors[word] += sign * *power;
      const std::size_t end = at_;
      skip_blanks();
      if (at_ == text_.size()) return factors;
      const char c = text_[at_];
      if (c == '/' || c == '*' || c == '.' || c == '-' || c == '_') {
        ++at_;
      } else if (at_ == end) {
        return std::nullopt;
      }
      sign = c == '/' ? -1 : 1;
    }
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  /// 1 without a power; nothing for what is no power.
  std::optional<int> read_power() {
    std::size_t at = at_;
    const bool is_marked = at < text_.size() && text_[at] == '^';
    if (is_marked) ++at;
    const bool is_negative = at < text_.size() && text_[at] == '-';
    if (is_negative || (at < text_.size() && text_[at] == '+')) ++at;
    if (at >= text_.size() || !arm::is_digit(text_[at])) {
      if (is_marked) return std::nullopt;
      return 1;
    }
    const int power = text_[at] - '0';
    at_ = at + 1;
    if (at_ < text_.size() && arm::is_digit(text_[at_])) return std::nullopt;
    return is_negative ? -power : power;
  }

  string_view text_;
  const Spellings& words_;
  std::size_t at_ = 0;
};

string_view find_spelled(string_view text, const SpelledUnits& units) {
  if (const auto unit = find_in(units.words, text); !unit.empty()) return unit;
  if (const auto unit = find_in(units.compounds, without_blanks(text)); !unit.empty()) return unit;
  const auto factors = FactorReader(text, units.words).read();
  if (!factors) return {};
  for (const auto& unit : compound_units()) {
    if (std::ranges::count(unit.factors, *factors) > 0) return unit.unit;
  }
  return {};
}

}  // namespace

std::string in_plain_signs(string_view text) {
  std::string out;
  while (!text.empty()) {
    // Longer signs first: superscript minus and 2 before superscript 2.
    string_view best;
    string_view with;
    for (const auto& [sign, plain] : kSigns) {
      if (text.starts_with(sign) && sign.size() > best.size()) {
        best = sign;
        with = plain;
      }
    }
    if (best.empty()) {
      out += text.front();
      text.remove_prefix(1);
    } else {
      out += with;
      text.remove_prefix(best.size());
    }
  }
  return out;
}

std::string find_unit(string_view text) {
  static const SpelledUnits as_written = spelled_units(false);
  static const SpelledUnits in_lower = spelled_units(true);
  string_view typed = trimmed(text);
  if (typed.size() > kLongestUnit) return {};
  if (typed.size() > 2 && typed.ends_with('.')) typed.remove_suffix(1);  // "sec.", "Deg."
  const std::string plain = in_plain_signs(typed);
  string_view unit = find_spelled(plain, as_written);
  // A capital tells S (siemens), G (gauss, or a response) or M apart: units of one letter are not
  // folded.
  if (unit.empty() && plain.size() != 1 && !has_mega(plain))
    unit = find_spelled(in_lower_case(plain), in_lower);
  return std::string(unit);
}

bool is_canonical_unit(string_view unit) {
  return std::ranges::count(unit_words(), unit,
                            [](const auto& word) -> string_view { return word.unit; }) > 0 ||
         std::ranges::count(compound_units(), unit,
                            [](const auto& compound) -> string_view { return compound.unit; }) > 0;
}

}  // namespace flexarm::measured
