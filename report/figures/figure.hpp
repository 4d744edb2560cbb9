#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

enum class Scale { linear, logarithmic };

struct Tick {
  double position = 0.0;
  std::string label = {};
};

struct Axis {
  std::string label = {};
  std::string unit = {};  ///< shown as "label [unit]"; empty: none is shown
  Scale scale = Scale::linear;
  std::optional<double> minimum = {};  ///< empty: from the data, with a margin
  std::optional<double> maximum = {};
  std::vector<Tick> ticks = {};  ///< empty: chosen from the range
  bool robust = false;  ///< outliers do not set the limits (report/figures/robust_range.hpp)
};

enum class Line { none, solid, dashed, dotted, dash_dotted };

enum class Marker {
  none,
  plus,
  cross,
  star,
  square,
  filled_square,
  circle,
  disc,
  triangle,
  filled_triangle,
  triangle_down,
  filled_triangle_down,
  diamond,
  filled_diamond,
  pentagon,
  filled_pentagon,
};

/// Colours that people with colour blindness distinguish [OkabeIto2008]; further indices begin
/// again at black.
enum Colour : int { black, blue, vermillion, green, purple, orange, sky_blue, grey, kColours };

struct Style {
  int colour = black;
  double tint = 0.0;  ///< 0: the colour itself, towards 1: white
  Line line = Line::solid;
  double line_width_px = 1.5;
  Marker marker = Marker::none;
  double marker_size = 1.0;  ///< relative to gnuplot's standard size
  bool filled = false;       ///< the area between `y` and `y_to`, without a line
};

/// A coordinate of a point that is left out.
inline constexpr double kNotDrawn = std::numeric_limits<double>::quiet_NaN();

/// Points (x[i], y[i]), joined in their order. A point that is not finite, or not positive on a
/// logarithmic axis, is a gap. Of more points than show, where x ascends, those that do are drawn
/// (report/figures/thinned_series.hpp). A name may be given to several series of one figure: the
/// legend shows it once, in the style of the first.
struct Series {
  std::string name = {};
  std::vector<double> x = {};
  std::vector<double> y = {};
  Style style = {};
  std::vector<double> y_to = {};  ///< of a filled area, one a point
};

/// Where a text stands, seen from its point. At the ends of curves it is moved up or down where
/// curves end close to each other.
enum class TextPlace { upper_right, above, below, left, right, centre, end };

/// Text beside a point of a panel.
struct Annotation {
  double x = 0.0;
  double y = 0.0;
  std::string text = {};
  TextPlace place = TextPlace::upper_right;
  std::optional<double> frequency_Hz = {};  ///< of a text that is a frequency in the axis' unit
};

struct Panel {
  std::string title = {};
  std::optional<Axis> x = {};  ///< empty: the stack's, shown under its lowest panel
  Axis y = {};
  std::vector<Series> series = {};
  std::vector<Annotation> annotations = {};
  double height = 1.0;    ///< relative to the other panels of its stack
  std::string note = {};  ///< above the panel, at its right side
};

/// Panels one above the other, on one x axis unless they have their own.
struct PanelStack {
  Axis x = {};
  std::vector<Panel> panels = {};
  double width = 1.0;    ///< relative to the other stacks of the figure
  bool square = false;   ///< panels with sides of equal length
  int blank_panels = 0;  ///< room left below, so that stacks of unlike length have equal panels
};

/// A line of the legend; without a style it is a heading.
struct LegendEntry {
  std::string text = {};
  std::optional<Style> style = {};
};

/// The font of everything but titles, unless a figure has its own: 10 points.
inline constexpr double kFontSize_px = 40.0 / 3.0;

inline constexpr const char* kSansSerif = "sans-serif";

/// A picture: stacks of panels side by side, with the legend to their right.
struct Figure {
  std::string title = {};
  std::vector<PanelStack> stacks = {};
  std::vector<LegendEntry> legend = {};  ///< empty: every series name once
  int width_px = 900;
  int height_px = 600;
  std::string font = kSansSerif;
  double font_size_px = kFontSize_px;
};

/// A figure and its file name without extension.
struct NamedFigure {
  std::string name = {};
  Figure figure = {};
};

}  // namespace flexarm::report
