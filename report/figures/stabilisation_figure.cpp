#include "report/figures/stabilisation_figure.hpp"

#include "report/figures/axis_units.hpp"
#include "report/figures/equal_axes.hpp"
#include "report/figures/feature_marks.hpp"
#include "report/figures/meaning.hpp"
#include "report/figures/measured_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace flexarm::report {
namespace {

constexpr int kStabilisationWidth_px = 1000;
constexpr int kStabilisationHeight_px = 600;
constexpr double kRoomBelow = 0.03;  // of the orders' range
constexpr double kRoomAbove = 0.14;  // for the labels

/// log |response| of a channel at a frequency.
double log_magnitude(const measured::FrequencyChannel& channel, double at_Hz) {
  const auto above = std::ranges::lower_bound(channel.frequency_Hz, at_Hz);
  if (above == channel.frequency_Hz.end()) return kNotDrawn;
  const auto i = static_cast<std::size_t>(above - channel.frequency_Hz.begin());
  const double here = std::log(std::abs(channel.response[i]));
  if (*above == at_Hz) return here;
  if (i == 0) return kNotDrawn;
  const double before = std::log(std::abs(channel.response[i - 1]));
  const double part =
      (at_Hz - channel.frequency_Hz[i - 1]) / (*above - channel.frequency_Hz[i - 1]);
  return before + part * (here - before);
}

enum class Stability { fresh, frequency, damping, all, kCount };

Stability stability_of(const measured::ChartPole& pole) {
  if (pole.stable()) return Stability::all;
  if (!pole.frequency_stable) return Stability::fresh;
  return pole.damping_stable ? Stability::damping : Stability::frequency;
}

struct Symbol {
  const char* name;
  Style style;
};

const std::array<Symbol, static_cast<std::size_t>(Stability::kCount)> kSymbols = {{
    {"new pole", marker_style(grey, Marker::plus, 0.6)},
    {"stable frequency", marker_style(orange, Marker::triangle, 0.7)},
    {"stable frequency and damping", marker_style(green, Marker::square, 0.7)},
    {"stable pole", marker_style(kIdentifiedColour, Marker::disc, 0.8)},
}};

/// The course of the background between two heights, with a gap between measured bands.
Series background_series(const MeanResponse& mean, const measured::StabilisationChart& chart,
                         double bottom, double top) {
  Series series{"mean |H|, log", {}, {}, thin_line(grey)};
  series.style.tint = 0.35;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < mean.frequency_Hz.size(); ++i) {
    const double f_Hz = mean.frequency_Hz[i];
    if (f_Hz < chart.from_Hz || f_Hz > chart.to_Hz) continue;
    const double value = mean.magnitude[i] > 0.0 ? std::log(mean.magnitude[i]) : kNotDrawn;
    if (begins_band(mean.frequency_Hz, i)) {
      series.x.push_back(f_Hz);
      series.y.push_back(kNotDrawn);
    }
    series.x.push_back(f_Hz);
    series.y.push_back(value);
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  for (double& value : series.y) {
    value = high > low ? bottom + (top - bottom) * (value - low) / (high - low) : kNotDrawn;
  }
  return series;
}

}  // namespace

MeanResponse mean_response(const measured::FrequencyRecord& record) {
  MeanResponse mean;
  if (record.channels.empty()) return mean;
  mean.frequency_Hz = record.channels.front().frequency_Hz;
  for (const double f_Hz : mean.frequency_Hz) {
    double sum = 0.0;
    for (const auto& channel : record.channels) sum += log_magnitude(channel, f_Hz);
    mean.magnitude.push_back(std::exp(sum / static_cast<double>(record.channels.size())));
  }
  return mean;
}

Figure stabilisation_figure(const measured::StabilisationChart& chart,
                            const StabilisationPlot& plot) {
  if (chart.poles.empty() || chart.orders.empty()) {
    throw std::invalid_argument(
        fmt::format("\"{}\": stabilisation chart without poles", plot.title));
  }
  const double lowest = *std::ranges::min_element(chart.orders);
  const double highest = *std::ranges::max_element(chart.orders);
  const double range = std::max(2.0, highest - lowest);
  Panel panel;
  panel.y = {.label = "order of the denominator",
             .minimum = lowest - kRoomBelow * range,
             .maximum = highest + kRoomAbove * range};
  if (plot.background) {
    Series course = background_series(*plot.background, chart, lowest, highest);
    if (!course.x.empty()) panel.series.push_back(std::move(course));
  }
  std::vector<double> fitted_Hz;
  for (const double f_Hz : plot.fitted_poles_Hz) {
    if (f_Hz < chart.from_Hz || f_Hz > chart.to_Hz) continue;
    fitted_Hz.push_back(f_Hz);
    panel.annotations.push_back({f_Hz, highest, frequency_text(f_Hz), TextPlace::above, f_Hz});
  }
  add_frequency_lines(panel, fitted_Hz, "fitted pole", thin_line(kIdentifiedColour));
  for (std::size_t kind = 0; kind < kSymbols.size(); ++kind) {
    Series series{kSymbols[kind].name, {}, {}, kSymbols[kind].style};
    for (const auto& pole : chart.poles) {
      if (static_cast<std::size_t>(stability_of(pole)) != kind) continue;
      series.x.push_back(pole.frequency_Hz);
      series.y.push_back(pole.order);
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  }
  PanelStack stack;
  stack.x = {.label = "frequency", .unit = "Hz", .minimum = chart.from_Hz, .maximum = chart.to_Hz};
  stack.panels.push_back(std::move(panel));
  Figure figure{.title = plot.title,
                .width_px = kStabilisationWidth_px,
                .height_px = kStabilisationHeight_px};
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
