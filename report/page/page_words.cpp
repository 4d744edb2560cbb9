#include "report/page/page_words.hpp"

#include "report/figures/sensor_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace flexarm::report::page {

namespace {

using Replacement = std::pair<std::string_view, std::string_view>;

/// What is more than blanks for underscores.
constexpr std::array<Replacement, 3> kNames = {{{"exact_tf", "exact transfer function"},
                                                {"fem", "finite elements"},
                                                {"assumed_modes", "assumed modes"}}};
constexpr std::array<Replacement, 3> kProperNouns = {
    {{"coulomb", "Coulomb"}, {"stribeck", "Stribeck"}, {"kelvin", "Kelvin"}}};

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// What stands behind "strain@": characters of a number.
std::string_view number_at(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? text.substr(0, static_cast<std::size_t>(end - text.data()))
                              : std::string_view();
}

std::string words_for(std::string_view name) {
  for (const auto& [id, words] : kNames) {
    if (name == id) return std::string(words);
  }
  if (name.find('_') == std::string_view::npos) return std::string(name);
  std::string made;
  std::size_t from = 0;
  while (from <= name.size()) {
    const std::size_t to = std::min(name.find('_', from), name.size());
    std::string_view part = name.substr(from, to - from);
    for (const auto& [id, noun] : kProperNouns) {
      if (part == id) part = noun;
    }
    if (!made.empty() && !part.empty()) made += ' ';
    made += part;
    from = to + 1;
  }
  return made;
}

/// Whether a name that begins or ends there is part of a key or of a file's name.
bool is_in_key(std::string_view text, std::size_t from, std::size_t to) {
  const bool dot_before =
      from >= 2 && (text[from - 1] == '.' || text[from - 1] == '/') && text[from - 2] != ' ';
  const bool dot_behind = to + 1 < text.size() && (text[to] == '.' || text[to] == '/') &&
                          is_word_character(text[to + 1]);
  return dot_before || dot_behind;
}

}  // namespace

std::string in_words(std::string_view text) {
  constexpr std::string_view kStrain = "strain";
  std::string made;
  std::size_t at = 0;
  while (at < text.size()) {
    if (!is_word_character(text[at])) {
      made += text[at++];
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && is_word_character(text[end])) ++end;
    const std::string_view name = text.substr(at, end - at);
    if (name == kStrain && end < text.size() && text[end] == '@') {
      const std::string_view place = number_at(text.substr(end + 1));
      made += fmt::format("strain at {} m", place);
      at = end + 1 + place.size();
      continue;
    }
    made += is_in_key(text, at, end) ? std::string(name) : words_for(name);
    at = end;
  }
  return made;
}

std::string parameter_words(const std::string& key) {
  constexpr std::string_view kEffects = "effects.";
  std::string text = key.starts_with(kEffects) ? key.substr(kEffects.size()) : key;
  std::ranges::replace(text, '.', '_');
  return in_words(text);
}

std::string sentence_of(std::string_view text) {
  std::string made = in_words(text);
  if (!made.empty()) made[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(made[0])));
  return made;
}

std::string printed_unit(std::string_view unit) {
  if (unit == "1") return "";
  std::string made;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const std::string_view rest = unit.substr(k);
    if (rest.starts_with("^2")) {
      made += "²";
      ++k;
    } else if (rest.starts_with("^3")) {
      made += "³";
      ++k;
    } else {
      made += unit[k];
    }
  }
  return made;
}

std::string response_unit(const arm::Sensor& sensor) {
  const std::string unit = printed_unit(arm::unit(sensor));
  if (unit.empty()) return "1/(N m)";
  return unit.find('/') == std::string::npos ? unit + "/(N m)" : "(" + unit + ")/(N m)";
}

std::string percent_of(double part) {
  return std::isfinite(part) ? fmt::format("{:.3g} %", 100.0 * part) : "–";
}

std::string number_of(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "–";
}

}  // namespace flexarm::report::page
