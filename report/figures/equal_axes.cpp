#include "report/figures/equal_axes.hpp"

#include <fmt/format.h>

#include <utility>

namespace flexarm::report {

Panel EqualAxes::panel(std::string title) const {
  const auto axis = [&](const char* part, double at) {
    return Axis{.label = fmt::format("{} {}", part, quantity),
                .unit = unit,
                .minimum = at - half_side,
                .maximum = at + half_side};
  };
  Panel panel;
  panel.title = std::move(title);
  panel.x = axis("Re", centre.real());
  panel.y = axis("Im", centre.imag());
  add_coordinate_axes(panel, *panel.x->minimum, *panel.x->maximum, *panel.y.minimum,
                      *panel.y.maximum);
  return panel;
}

Series complex_series(std::string name, std::span<const std::complex<double>> values,
                      const Style& style) {
  Series series{std::move(name), {}, {}, style};
  for (const auto& value : values) {
    series.x.push_back(value.real());
    series.y.push_back(value.imag());
  }
  return series;
}

void add_coordinate_axes(Panel& panel, double left, double right, double bottom, double top) {
  panel.series.push_back({"", {left, right}, {0.0, 0.0}, thin_line(grey)});
  panel.series.push_back({"", {0.0, 0.0}, {bottom, top}, thin_line(grey)});
}

Style thin_line(int colour, Line line) {
  Style style;
  style.colour = colour;
  style.line = line;
  style.line_width_px = 0.8;
  return style;
}

Style marker_style(int colour, Marker marker, double size) {
  Style style;
  style.colour = colour;
  style.line = Line::none;
  style.marker = marker;
  style.marker_size = size;
  return style;
}

}  // namespace flexarm::report
