#include "report/figures/bode_figure.hpp"

#include "report/figures/axis_units.hpp"
#include "report/figures/meaning.hpp"
#include "report/figures/overlay_style.hpp"
#include "report/figures/phase.hpp"
#include "report/figures/phase_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace flexarm::report {
namespace {

constexpr double kSmallestDrawnDifference = 0x1p-53;

/// One curve alone needs no broad band below others.
Style curve_style(const BodePlot& plot, std::size_t index) {
  return plot.curves.size() == 1 ? Style{.colour = kBaselineColour, .line_width_px = 1.6}
                                 : overlay_style(index);
}

Style root_style(bool pole) {
  Style style;
  style.colour = pole ? kPoleColour : kZeroColour;
  style.line = Line::none;
  style.marker = pole ? Marker::cross : Marker::circle;
  style.marker_size = 0.9;
  return style;
}

/// Crosses for poles, circles for zeros, below the curves.
void add_roots(const BodePlot& plot, Panel& panel) {
  if (plot.poles_Hz.empty() && plot.zeros_Hz.empty()) return;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const Series& series : panel.series) {
    for (const double value : series.y) {
      const double drawn = std::log10(value);
      if (!std::isfinite(drawn)) continue;
      lowest = std::min(lowest, drawn);
      highest = std::max(highest, drawn);
    }
  }
  if (!(lowest < highest)) return;
  constexpr double kBelow = 0.08;  // of the curves' height
  const double place = lowest - kBelow * (highest - lowest);
  for (const bool pole : {true, false}) {
    Series series{pole ? "poles" : "zeros", {}, {}, root_style(pole)};
    for (const double frequency : pole ? plot.poles_Hz : plot.zeros_Hz) {
      if (!(frequency >= plot.frequency_Hz.front() && frequency <= plot.frequency_Hz.back())) {
        continue;
      }
      series.x.push_back(frequency);
      series.y.push_back(std::pow(10.0, place));
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  }
}

Panel magnitude_panel(const BodePlot& plot) {
  Panel panel;
  panel.y = {.label = kMagnitude, .unit = plot.unit, .scale = Scale::logarithmic};
  panel.height = 1.8;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    Series series{plot.curves[c].name, plot.frequency_Hz, {}, curve_style(plot, c)};
    for (const auto& value : plot.curves[c].response) {
      series.y.push_back(std::abs(value));
    }
    panel.series.push_back(std::move(series));
  }
  add_roots(plot, panel);
  return panel;
}

Panel phase_panel(const BodePlot& plot) {
  Panel panel;
  panel.height = 1.2;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const BodeCurve& curve = plot.curves[c];
    panel.series.push_back(phase_series(
        curve.name, plot.frequency_Hz,
        curve.phase_deg.empty() ? continuous_phase_deg(curve.response) : curve.phase_deg,
        curve_style(plot, c)));
  }
  panel.y = phase_axis(panel.series);
  return panel;
}

Panel difference_panel(const BodePlot& plot) {
  Panel panel;
  panel.y = {.label = "relative difference", .scale = Scale::logarithmic};
  panel.height = 1.5;
  const auto& reference = plot.curves.front().response;
  for (std::size_t c = 1; c < plot.curves.size(); ++c) {
    Series series{plot.curves[c].name, plot.frequency_Hz, {}, overlay_style(c)};
    series.style.line = Line::solid;  // noise would hide the breaks of a broken line
    series.style.line_width_px = 1.2;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double difference =
          std::abs(plot.curves[c].response[i] - reference[i]) / std::abs(reference[i]);
      series.y.push_back(difference < kSmallestDrawnDifference ? kSmallestDrawnDifference
                                                               : difference);
    }
    panel.series.push_back(std::move(series));
  }
  if (!plot.one_minus_coherence.empty()) {
    Series series{"model disagreement", plot.frequency_Hz, {}, {.colour = grey}};
    series.style.line_width_px = 1.0;
    for (const double value : plot.one_minus_coherence) {
      series.y.push_back(std::fmax(std::sqrt(value), kSmallestDrawnDifference));
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

}  // namespace

Figure bode_figure(const BodePlot& plot) {
  for (const BodeCurve& curve : plot.curves) {
    if (curve.response.size() != plot.frequency_Hz.size()) {
      throw std::invalid_argument(fmt::format("{}: {} responses at {} frequencies", curve.name,
                                              curve.response.size(), plot.frequency_Hz.size()));
    }
  }
  PanelStack stack;
  stack.x = {.label = "frequency", .unit = "Hz", .scale = Scale::logarithmic};
  stack.panels = {magnitude_panel(plot), phase_panel(plot)};
  if (plot.curves.size() > 1) stack.panels.push_back(difference_panel(plot));
  return {.title = plot.title, .stacks = {std::move(stack)}};
}

}  // namespace flexarm::report
