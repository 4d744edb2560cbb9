#include "report/figures/mode_shape_figure.hpp"

#include "report/figures/meaning.hpp"
#include "report/figures/overlay_style.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>

namespace flexarm::report {
namespace {

constexpr std::size_t kModesInOneColumn = 3;

Panel mode_panel(const ModeShapePlot& plot, const ModeShape& mode) {
  Panel panel;
  panel.title = mode.label;
  panel.y = {.label = "displacement", .unit = plot.displacement_unit};
  Style zero_line;
  zero_line.colour = grey;
  zero_line.line_width_px = 0.8;
  panel.series.push_back(
      {"", {plot.station_m.front(), plot.station_m.back()}, {0.0, 0.0}, zero_line});
  for (std::size_t i = 0; i < mode.curves.size(); ++i) {
    const ModeShapeCurve& curve = mode.curves[i];
    if (curve.displacement.size() != plot.station_m.size()) {
      throw std::invalid_argument(fmt::format("{}, {}: {} nuisances at {} stations", mode.label,
                                              curve.formulation, curve.displacement.size(),
                                              plot.station_m.size()));
    }
    panel.series.push_back(
        {curve.formulation, plot.station_m, curve.displacement,
         mode.curves.size() > 1 ? overlay_style(i) : Style{.colour = kBaselineColour}});
  }
  return panel;
}

}  // namespace

Figure mode_shape_figure(const ModeShapePlot& plot) {
  if (plot.station_m.empty()) throw std::invalid_argument("mode shapes without a station");
  Figure figure;
  figure.title = plot.title;
  const std::size_t columns = plot.modes.size() > kModesInOneColumn ? 2 : 1;
  const std::size_t rows = (plot.modes.size() + columns - 1) / columns;
  for (std::size_t i = 0; i < plot.modes.size(); ++i) {
    if (i % rows == 0) {
      figure.stacks.push_back({.x = {.label = "distance from the motor axis", .unit = "m"}});
    }
    figure.stacks.back().panels.push_back(mode_panel(plot, plot.modes[i]));
  }
  if (!figure.stacks.empty()) {
    figure.stacks.back().blank_panels = static_cast<int>(columns * rows - plot.modes.size());
  }
  return figure;
}

}  // namespace flexarm::report
