#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/text_size.hpp"

#include <cstddef>
#include <optional>
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
  double label_px = 0.0;  ///< from the left side out to the middle of the axis label's first line
  Range x;
  Range y;
  std::vector<Tick> x_ticks = {};
  std::vector<Tick> y_ticks = {};
  std::string x_label = {};  ///< with unit and power of ten: "time [10⁻³ s]"
  std::string y_label = {};  ///< the same, in lines that fit beside the panel
  std::string note = {};     ///< the panel's, and how many points lie outside a robust range
  TextSize text = {};
};

/// A line of the legend and where it stands, in lines that fit beside the panels.
struct PlacedLegendEntry {
  std::string text = {};
  std::optional<Style> style = {};
  double left_px = 0.0;    ///< of its sample
  double middle_px = 0.0;  ///< of the first line, from the lower side of the figure
};

/// Where everything stands: `boxes[stack][panel]`.
struct FigureLayout {
  std::vector<std::vector<PanelBox>> boxes;
  std::string title;      ///< in lines
  double title_px = 0.0;  ///< middle of the first line
  std::vector<PlacedLegendEntry> legend;
};

/// Of a legend entry: length of the sample, and from its start to the text.
inline constexpr double kLegendSample_px = 34.0;
inline constexpr double kLegendText_px = 44.0;

/// Whether a point of a series is drawn: finite, and positive on a logarithmic axis.
bool is_drawable(double value, const Axis& axis);

/// Whether a point of a series, with a filled area's other side, is.
bool is_drawable(const Series& series, std::size_t point, const Axis& x, const Axis& y);

/// The value itself, or its decadic logarithm where the axis is logarithmic; and back.
double on_scale(double value, const Axis& axis);
double from_scale(double value, const Axis& axis);

/// Without a legend of its own a figure's legend has each name once whose series shows in its
/// panel. Throws std::invalid_argument for a figure without panels, a series without points or with
/// x and y of different lengths, a panel with no point to draw, and limits that make no range.
FigureLayout lay_out(const Figure& figure);

}  // namespace flexarm::report
