#include "report/figures/convergence_figure.hpp"

#include "report/figures/overlay_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace flexarm::report {
namespace {

constexpr std::array kMarkers{Marker::circle,        Marker::square,        Marker::triangle,
                              Marker::diamond,       Marker::triangle_down, Marker::pentagon,
                              Marker::plus,          Marker::cross,         Marker::star,
                              Marker::disc,          Marker::filled_square, Marker::filled_triangle,
                              Marker::filled_diamond};
constexpr double kPalestTint = 0.6;
constexpr double kSlopeAboveCurves = 3.0;  // factor, so that the line stands clear of markers
constexpr double kAsymptoticError = 1e-2;  // curves bend above this error
constexpr double kSlopeTop = 0.3;          // error at which a reference slope begins, at most

/// Index of `name` in `names`, where it is put when it is new.
std::size_t index_of(const std::string& name, std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  const auto index = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return index;
}

Style feature_style(std::size_t feature, std::size_t features) {
  Style style;
  style.marker = kMarkers[feature % kMarkers.size()];
  style.marker_size = 0.7;
  style.line_width_px = 1.3;
  style.tint = kPalestTint * static_cast<double>(feature) /
               static_cast<double>(std::max<std::size_t>(features - 1, 1));
  return style;
}

Series curve_series(const ConvergenceCurve& curve, const Style& style) {
  Series series{curve.formulation + ", " + curve.feature, curve.degrees_of_freedom,
                curve.relative_error, style};
  for (double& error : series.y) {
    if (error < kSmallestDrawnError) error = kSmallestDrawnError;
  }
  return series;
}

/// error = level x^-order, with the smallest `level` that clears the falling part of every curve;
/// empty when no curve of the formulation has one.
std::optional<Series> slope_series(const ReferenceSlope& slope,
                                   const std::vector<ConvergenceCurve>& curves) {
  double level = 0.0;
  double first_x = std::numeric_limits<double>::infinity();
  double last_x = 0.0;
  double smallest_error = std::numeric_limits<double>::infinity();
  for (const ConvergenceCurve& curve : curves) {
    if (curve.formulation != slope.formulation) continue;
    for (std::size_t i = 0; i < curve.relative_error.size(); ++i) {
      const double x = curve.degrees_of_freedom[i];
      const double error = std::max(curve.relative_error[i], kSmallestDrawnError);
      if (!(error <= kAsymptoticError)) continue;
      first_x = std::min(first_x, x);
      last_x = std::max(last_x, x);
      smallest_error = std::min(smallest_error, error);
      if (i > 0 && curve.relative_error[i] >
                       curve.relative_error[i - 1] *
                           std::pow(curve.degrees_of_freedom[i - 1] / x, slope.order / 2)) {
        break;  // less than half the order from one point to the next: rounding has taken over
      }
      level = std::max(level, kSlopeAboveCurves * error * std::pow(x, slope.order));
    }
  }
  if (level == 0.0) return {};
  const auto x_of = [&](double error) { return std::pow(level / error, 1.0 / slope.order); };
  const double begin = std::max(first_x, x_of(kSlopeTop));
  const double end = std::max(begin, std::min(last_x, x_of(smallest_error)));
  const auto error_of = [&](double x) { return level * std::pow(x, -slope.order); };
  Style style;
  style.colour = grey;
  return Series{fmt::format("order {} ({})", slope.order, slope.formulation),
                {begin, end},
                {error_of(begin), error_of(end)},
                style};
}

}  // namespace

Figure convergence_figure(const ConvergencePlot& plot) {
  std::vector<std::string> formulations;
  std::vector<std::string> features;
  for (const ConvergenceCurve& curve : plot.curves) {
    if (curve.degrees_of_freedom.size() != curve.relative_error.size()) {
      throw std::invalid_argument(
          fmt::format("{}, {}: {} degrees of freedom and {} errors", curve.formulation,
                      curve.feature, curve.degrees_of_freedom.size(), curve.relative_error.size()));
    }
    index_of(curve.formulation, formulations);
    index_of(curve.feature, features);
  }

  Figure figure;
  figure.title = plot.title;
  Panel panel;
  panel.y = {.label = "relative error", .scale = Scale::logarithmic};
  double first_x = std::numeric_limits<double>::infinity();
  double last_x = 0.0;
  for (const ConvergenceCurve& curve : plot.curves) {
    Style style = feature_style(index_of(curve.feature, features), features.size());
    // The first colour is the exact formulation's, which has no error to show.
    style.colour = formulation_colour(1 + index_of(curve.formulation, formulations));
    panel.series.push_back(curve_series(curve, style));
    for (const double x : curve.degrees_of_freedom) {
      first_x = std::min(first_x, x);
      last_x = std::max(last_x, x);
    }
  }

  for (std::size_t i = 0; i < formulations.size(); ++i) {
    Style style;
    style.colour = formulation_colour(1 + i);
    style.line_width_px = 3.0;
    figure.legend.push_back({formulations[i], style});
  }
  figure.legend.push_back({" ", {}});
  for (std::size_t i = 0; i < features.size(); ++i) {
    figure.legend.push_back({features[i], feature_style(i, features.size())});
  }
  if (!plot.slopes.empty() || plot.rounding_level) figure.legend.push_back({" ", {}});
  for (std::size_t i = 0; i < plot.slopes.size(); ++i) {
    if (std::optional<Series> series = slope_series(plot.slopes[i], plot.curves)) {
      series->style.line = i % 2 == 0 ? Line::dashed : Line::dash_dotted;
      figure.legend.push_back({series->name, series->style});
      panel.series.push_back(std::move(*series));
    }
  }
  if (plot.rounding_level) {
    Style style;
    style.colour = grey;
    style.line = Line::dotted;
    const double level = *plot.rounding_level;
    panel.series.push_back({"rounding", {first_x, last_x}, {level, level}, style});
    figure.legend.push_back({"rounding", style});
  }
  figure.stacks.push_back(
      {.x = {.label = "degrees of freedom", .scale = Scale::logarithmic}, .panels = {panel}});
  return figure;
}

}  // namespace flexarm::report
