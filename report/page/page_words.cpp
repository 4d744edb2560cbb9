#include "report/page/page_words.hpp"

#include "report/figures/sensor_label.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace flexarm::report::page {

namespace {

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

/// Whether a name that begins or ends there is part of a key or of a file's name.
bool is_in_key(std::string_view text, std::size_t from, std::size_t to) {
  const bool dot_before =
      from >= 2 && (text[from - 1] == '.' || text[from - 1] == '/') && text[from - 2] != ' ';
  const bool dot_behind = to + 1 < text.size() && (text[to] == '.' || text[to] == '/') &&
                          is_word_character(text[to + 1]);
  return dot_before || dot_behind;
}

}  // namespace

std::string text_in_words(std::string_view text) {
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
    made += is_in_key(text, at, end) ? std::string(name) : id_in_words(name);
    at = end;
  }
  return made;
}

std::string sentence_of(std::string_view text) {
  std::string made = text_in_words(text);
  if (!made.empty()) made[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(made[0])));
  return made;
}

std::string response_unit(const arm::Sensor& sensor, const std::optional<arm::Sensor>& input) {
  const std::string unit = axis_unit(sensor);
  const std::string per = input ? axis_unit(*input) : "N m";
  const std::string behind = per == "rad" ? "/rad" : fmt::format("/({})", per);
  if (unit.empty()) return "1" + behind;
  return unit.find('/') == std::string::npos ? unit + behind : "(" + unit + ")" + behind;
}

std::string percent_of(double part) {
  if (!std::isfinite(part)) return "–";
  const double percent = 100.0 * part;
  return std::abs(percent) < 1000.0 ? fmt::format("{:.3g} %", percent)
                                    : fmt::format("{:.0f} %", percent);
}

std::string estimate_of(double value, double std_error, const std::string& unit) {
  constexpr int kDigitsOfError = 2;
  constexpr int kWithoutError = 6;
  constexpr int kMostDigits = 12;
  int digits = kWithoutError;
  if (std_error > 0.0 && std::isfinite(std_error) && value != 0.0) {
    const double decades =
        std::floor(std::log10(std::abs(value))) - std::floor(std::log10(std_error));
    digits = std::clamp(kDigitsOfError + static_cast<int>(decades), 1, kMostDigits);
  }
  const std::string printed = unit_text(unit);
  return fmt::format("{} ± {}{}{}", number_of(value, digits), number_of(std_error, kDigitsOfError),
                     printed.empty() ? "" : " ", printed);
}

std::string number_of(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "–";
}

}  // namespace flexarm::report::page
