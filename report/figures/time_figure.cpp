#include "report/figures/time_figure.hpp"

#include "report/figures/meaning.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>

namespace flexarm::report {
namespace {

constexpr int kTimePanel_px = 195;      // "tip acceleration [m/s²]" fits beside it
constexpr int kTimeFurniture_px = 110;  // title and time axis

/// Thin lines, as signals turn often; the first of several, on which the others lie, broader and
/// pale.
Style style_of(std::size_t i, std::size_t curves) {
  Style style;
  style.colour = i == 0 ? kBaselineColour : green;
  const bool is_below = i == 0 && curves > 1;
  style.line_width_px = is_below ? 2.5 : 1.1;
  style.tint = is_below ? 0.6 : 0.0;
  return style;
}

Series series_of(const TimePlot& plot, const TimeCurve& curve, const Style& style) {
  if (curve.values.size() != plot.time_s.size()) {
    throw std::invalid_argument(fmt::format("{}: {} values at {} times", curve.name,
                                            curve.values.size(), plot.time_s.size()));
  }
  return {curve.name, plot.time_s, curve.values, style};
}

}  // namespace

Figure time_figure(const TimePlot& plot) {
  if (plot.panels.empty()) throw std::invalid_argument("signals over time without a panel");
  Figure figure;
  figure.title = plot.title;
  figure.height_px = kTimeFurniture_px + kTimePanel_px * static_cast<int>(plot.panels.size());
  PanelStack stack{.x = {.label = "time", .unit = "s"}};
  for (const auto& panel : plot.panels) {
    Panel drawn{.y = {.label = panel.label, .unit = panel.unit, .robust = panel.robust}};
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      drawn.series.push_back(series_of(plot, panel.curves[i], style_of(i, panel.curves.size())));
    }
    stack.panels.push_back(std::move(drawn));
  }
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
