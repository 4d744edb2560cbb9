#include "report/figures/overlay_style.hpp"

#include <algorithm>
#include <array>

namespace flexarm::report {

int formulation_colour(std::size_t i) {
  constexpr std::array<int, 5> kFormulations{green, purple, orange, sky_blue, grey};
  return kFormulations[i % kFormulations.size()];
}

Style overlay_style(std::size_t i) {
  constexpr std::array<Line, 4> kLines{Line::solid, Line::solid, Line::dashed, Line::dotted};
  Style style;
  style.colour = formulation_colour(i);
  style.line = kLines[std::min(i, kLines.size() - 1)];
  style.line_width_px = i == 0 ? 5.0 : 1.8;
  style.tint = i == 0 ? 0.6 : 0.0;
  return style;
}

}  // namespace flexarm::report
