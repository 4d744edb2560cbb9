#include "report/figures/feature_marks.hpp"

#include "report/figures/axis_units.hpp"
#include "report/figures/equal_axes.hpp"
#include "report/figures/figure_layout.hpp"
#include "report/figures/meaning.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace flexarm::report {
namespace {

constexpr std::size_t kLowestPart = 50;
constexpr double kDecadesBelow = 3.0;
constexpr double kFlat = 0.1;  // decades: a flat spectrum is shown as one

}  // namespace

void add_feature_marks(Panel& panel, std::span<const measured::SpectralFeature> features,
                       FeatureLevel level) {
  const double dB_per_decade = level == FeatureLevel::power ? 10.0 : 20.0;
  std::vector<measured::SpectralFeature> sorted(features.begin(), features.end());
  std::ranges::stable_sort(sorted, std::greater(), &measured::SpectralFeature::prominence_dB);
  for (const auto kind : {measured::Feature::pole, measured::Feature::zero}) {
    const bool peak = kind == measured::Feature::pole;
    Series series{
        peak ? "peak" : "minimum",
        {},
        {},
        marker_style(peak ? kPoleColour : kZeroColour, peak ? Marker::cross : Marker::circle, 0.8)};
    series.style.line_width_px = 1.8;
    for (const auto& feature : sorted) {
      if (feature.feature != kind) continue;
      series.x.push_back(feature.line_Hz);
      series.y.push_back(std::pow(10.0, feature.level_dB / dB_per_decade));
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  }
  for (const auto& feature : sorted) {
    panel.annotations.push_back(
        {feature.line_Hz, std::pow(10.0, feature.level_dB / dB_per_decade),
         frequency_text(feature.frequency_Hz),
         feature.feature == measured::Feature::pole ? TextPlace::above : TextPlace::below,
         feature.frequency_Hz});
  }
}

void fix_limits(Panel& panel, double room) {
  std::vector<double> values;
  for (const Series& series : panel.series) {
    if (series.style.filled) continue;
    for (const double value : series.y) {
      if (is_drawable(value, panel.y)) values.push_back(on_scale(value, panel.y));
    }
  }
  if (values.empty()) return;  // nothing to draw, which lay_out refuses by name
  std::ranges::sort(values);
  const double high = values.back();
  const double low = std::max(values.front(), values[values.size() / kLowestPart] - kDecadesBelow);
  const double margin = high - low > kFlat ? room * (high - low) : 0.5;
  panel.y.minimum = from_scale(low - margin, panel.y);
  panel.y.maximum = from_scale(high + margin, panel.y);
}

void add_frequency_lines(Panel& panel, std::span<const double> frequency_Hz,
                         const std::string& name, const Style& style) {
  if (!panel.y.minimum || !panel.y.maximum || frequency_Hz.empty()) return;
  Series series{name, {}, {}, style};
  for (const double at_Hz : frequency_Hz) {
    series.x.insert(series.x.end(), 3, at_Hz);
    series.y.insert(series.y.end(),
                    {*panel.y.minimum, *panel.y.maximum, std::numeric_limits<double>::quiet_NaN()});
  }
  panel.series.insert(panel.series.begin(), std::move(series));
}

Style analytical_pole_style() {
  Style style = thin_line(kBaselineColour, Line::dashed);
  style.tint = 0.45;
  style.line_width_px = 1.0;
  return style;
}

}  // namespace flexarm::report
