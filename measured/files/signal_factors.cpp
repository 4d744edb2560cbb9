#include "measured/files/signal_factors.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace flexarm::measured {

using std::string_view;

std::string unapplied_factor(string_view path, double value) {
  constexpr std::array<string_view, 10> kScales = {
      "scale",       "gain",        "factor",     "scaling",     "slope",
      "scalefactor", "sensitivity", "multiplier", "calibration", "resolution"};
  constexpr std::array<string_view, 4> kOffsets = {"offset", "bias", "intercept", "zero"};
  const auto point = path.rfind('.');
  if (point == string_view::npos) return "";
  const std::string name = plain_letters(path.substr(point + 1));
  const bool is_scale = std::ranges::count(kScales, string_view(name)) > 0 && value != 1.0;
  const bool is_offset = std::ranges::count(kOffsets, string_view(name)) > 0 && value != 0.0;
  if (!is_scale && !is_offset) return "";
  return fmt::format("{} = {:g} is not applied to the signal beside it; if the numbers lack it, {}",
                     arm::shown(std::string(path)), value,
                     is_scale ? "state it as SCALE in --column" : "add it in the file");
}

}  // namespace flexarm::measured
