#include "report/figures/logarithmic_ticks.hpp"

#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::report {
namespace {

constexpr int kSmallestPlainTick = -3;
constexpr int kLargestPlainExponent = 4;
constexpr int kMostDecadesWithDigits = 12;  // ticks for the digits are noise beyond

}  // namespace

std::string decade_label(int exponent, bool plain) {
  if (plain) {
    return fmt::format("{:.{}f}", std::pow(10.0, exponent), std::max(0, -exponent));
  }
  return "10" + superscript(exponent);
}

std::vector<Tick> logarithmic_ticks(const Range& range, int most_labels) {
  const int first = static_cast<int>(std::floor(std::log10(range.from)));
  const int last = static_cast<int>(std::floor(std::log10(range.to)));
  const int whole_decades = last - static_cast<int>(std::ceil(std::log10(range.from))) + 1;
  const int step = std::max(1, (whole_decades + most_labels - 1) / std::max(1, most_labels));

  // Of 2 and 5 a narrow range has one or none: then every digit is labelled.
  constexpr double kNarrow = 10.0;
  const bool narrow = range.to < kNarrow * range.from && most_labels >= 9;
  const bool plain = first >= kSmallestPlainTick && last <= kLargestPlainExponent;

  std::vector<Tick> ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    const double decade = std::pow(10.0, exponent);
    const int digits = last - first <= kMostDecadesWithDigits && step == 1 ? 9 : 1;
    for (int digit = 1; digit <= digits; ++digit) {
      const double position = digit * decade;
      if (position < range.from || position > range.to) continue;
      std::string label;
      if (digit == 1 && exponent % step == 0) label = decade_label(exponent, plain);
      if (whole_decades < 2 && (digit == 2 || digit == 5 || (narrow && digit > 1))) {
        label = plain ? fmt::format("{:g}", position)
                      : fmt::format("{}·{}", digit, decade_label(exponent, false));
      }
      ticks.push_back({position, std::move(label)});
    }
  }
  return ticks;
}

}  // namespace flexarm::report
