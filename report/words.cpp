#include "report/words.hpp"

#include "arm/ascii.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <regex>
#include <utility>

namespace flexarm::report {
namespace {

using Spelling = std::pair<std::string_view, std::string_view>;

/// Ids whose words do not follow from their parts.
constexpr std::array kIds = {
    Spelling{"fem", "finite elements"},
    Spelling{"exact_tf", "exact transfer function"},
    Spelling{"back_emf", "back-EMF"},
    Spelling{"damping.kelvin_voigt", "Kelvin-Voigt damping"},
    Spelling{"kelvin_voigt", "Kelvin-Voigt"},
};

/// Parts of ids that are names.
constexpr std::array kNames = {
    Spelling{"coulomb", "Coulomb"},
    Spelling{"stribeck", "Stribeck"},
    Spelling{"youngs", "Young's"},
};

constexpr std::string_view kEffects = "effects.";

/// What the table has for `id`, or itself.
template <std::size_t n>
std::string_view spelt(const std::array<Spelling, n>& spellings, std::string_view id) {
  const auto* const found = std::ranges::find(spellings, id, &Spelling::first);
  return found == spellings.end() ? id : found->second;
}

}  // namespace

std::string id_in_words(std::string_view id) {
  if (id.starts_with(kEffects)) {
    // "effects.back_emf.constant": the effect, then its parameter.
    id.remove_prefix(kEffects.size());
    const std::size_t dot = std::min(id.find('.'), id.size());
    const std::string effect = id_in_words(id.substr(0, dot));
    return dot == id.size() ? effect : effect + " " + id_in_words(id.substr(dot + 1));
  }
  if (const std::string_view words = spelt(kIds, id); words != id) return std::string(words);
  std::string words;
  while (!id.empty()) {
    const std::size_t end = std::min(id.find_first_of("_."), id.size());
    words += fmt::format("{}{}", words.empty() ? "" : " ", spelt(kNames, id.substr(0, end)));
    id.remove_prefix(std::min(end + 1, id.size()));
  }
  return words;
}

std::string in_words(std::string_view text) {
  // Parts joined by "_" or ".", and the position of a sensor [m].
  static const std::regex id(
      R"(([A-Za-z][A-Za-z0-9]*(?:[_.][A-Za-z0-9]+)*)(?:@([0-9]+(?:\.[0-9]+)?(?:[eE][-+]?[0-9]+)?))?)");
  const std::string whole(text);
  std::string words;
  auto rest = whole.cbegin();
  for (std::sregex_iterator found(whole.begin(), whole.end(), id), end; found != end; ++found) {
    const std::smatch& match = *found;
    words.append(rest, match[0].first);
    words += id_in_words(match[1].str());
    if (match[2].matched) words += fmt::format(" at {} m", match[2].str());
    rest = match[0].second;
  }
  return words.append(rest, whole.cend());
}

std::string superscript(int exponent) {
  static constexpr std::array<std::string_view, 10> kDigits{"⁰", "¹", "²", "³", "⁴",
                                                            "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : fmt::format("{}", std::abs(exponent))) {
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

std::string unit_text(std::string_view unit) {
  if (unit == "1") return "";
  std::string text;
  while (!unit.empty()) {
    std::size_t end = 1;
    if (unit.starts_with('^')) {
      if (unit.substr(1).starts_with('-')) ++end;
      while (end < unit.size() && arm::is_digit(unit[end])) ++end;
    }
    const std::string exponent(unit.substr(1, end - 1));
    const bool raises = !exponent.empty() && arm::is_digit(exponent.back());
    text += raises ? superscript(std::atoi(exponent.c_str())) : std::string(unit.substr(0, end));
    unit.remove_prefix(end);
  }
  return text;
}

}  // namespace flexarm::report
