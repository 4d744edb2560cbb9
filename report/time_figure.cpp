#include "report/time_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

namespace flexarm::report {
namespace {

/// About one stretch a pixel.
constexpr std::size_t kStretches = 1000;
constexpr std::size_t kMostPoints = 4 * kStretches;

constexpr int kPanelHeight_px = 195;  // "tip acceleration [m/s^2]" fits beside it
constexpr int kFurniture_px = 110;    // title and time axis

/// Samples that are drawn of a long signal, ascending.
std::vector<std::size_t> shown_samples(const std::vector<double>& values) {
  std::vector<std::size_t> samples;
  const std::size_t count = values.size();
  for (std::size_t stretch = 0; stretch < kStretches; ++stretch) {
    const std::size_t begin = stretch * count / kStretches;
    const std::size_t end = (stretch + 1) * count / kStretches;
    const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto [least, largest] = std::minmax_element(at(begin), at(end));
    std::array<std::size_t, 4> few = {begin, static_cast<std::size_t>(least - values.begin()),
                                      static_cast<std::size_t>(largest - values.begin()), end - 1};
    std::ranges::sort(few);
    for (const std::size_t sample : few) {
      if (samples.empty() || samples.back() < sample) samples.push_back(sample);
    }
  }
  return samples;
}

/// Thin lines, as signals turn often; the first of several, on which the others lie, broader and
/// pale.
Style style_of(std::size_t i, std::size_t curves) {
  Style style;
  style.colour = static_cast<int>(i % kColours);
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
  if (curve.values.size() <= kMostPoints) return {curve.name, plot.time_s, curve.values, style};
  Series series{curve.name, {}, {}, style};
  for (const std::size_t sample : shown_samples(curve.values)) {
    series.x.push_back(plot.time_s[sample]);
    series.y.push_back(curve.values[sample]);
  }
  return series;
}

}  // namespace

Figure time_figure(const TimePlot& plot) {
  if (plot.panels.empty()) throw std::invalid_argument("signals over time without a panel");
  Figure figure;
  figure.title = plot.title;
  figure.height_px = kFurniture_px + kPanelHeight_px * static_cast<int>(plot.panels.size());
  PanelStack stack{.x = {.label = "time", .unit = "s"}};
  for (const auto& panel : plot.panels) {
    Panel drawn{.y = {.label = panel.label, .unit = panel.unit}};
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      drawn.series.push_back(series_of(plot, panel.curves[i], style_of(i, panel.curves.size())));
    }
    stack.panels.push_back(std::move(drawn));
  }
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
