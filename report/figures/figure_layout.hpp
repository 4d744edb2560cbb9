#pragma once

#include "report/figures/figure.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::report {

struct Range {
  double from = 0.0;
  double to = 1.0;
};

/// A panel's plotting area in pixels from the lower left corner of the figure, and what it shows.
struct PanelBox {
  double left_px = 0.0;
  double right_px = 0.0;
  double bottom_px = 0.0;
  double top_px = 0.0;
  double label_px = 0.0;  ///< from the left side out to the middle of the axis label
  Range x;
  Range y;
};

/// Where everything stands: `boxes[stack][panel]`.
struct FigureLayout {
  std::vector<std::vector<PanelBox>> boxes;
  std::vector<LegendEntry> legend;
  double legend_left_px = 0.0;
  double legend_top_px = 0.0;
  int legend_rows = 0;
};

/// The font of everything but titles; widths and heights of text follow from it.
inline constexpr double kFontSize_px = 13.0;
/// From a point to the middle of a text above or below it, and to the end of one beside it.
inline constexpr double kTextAbove_px = 13.0;
inline constexpr double kTextBeside_px = 11.0;
/// From one line of the legend to the next.
inline constexpr double kLegendRow_px = 20.5;

/// Whether a point of a series is drawn: finite, and positive on a logarithmic axis.
bool is_drawable(double value, const Axis& axis);

/// Whether a point of a series, with a filled area's other side, is.
bool is_drawable(const Series& series, std::size_t point, const Axis& x, const Axis& y);

/// The value itself, or its decadic logarithm where the axis is logarithmic; and back.
double on_scale(double value, const Axis& axis);
double from_scale(double value, const Axis& axis);

/// About: the mean advance of a broad sans-serif face.
double text_width_px(const std::string& text);

/// Throws std::invalid_argument for a figure without panels, a series without points or with x and
/// y of different lengths, a panel with no point to draw, and limits that make no range.
FigureLayout lay_out(const Figure& figure);

}  // namespace flexarm::report
