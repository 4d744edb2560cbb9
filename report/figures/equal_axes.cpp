#include "report/figures/equal_axes.hpp"

#include "report/figures/logarithmic_ticks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace flexarm::report {
namespace {

/// Power of ten, a multiple of three, in which numbers up to `largest` have few digits; 0 where
/// they have few without.
int exponent_for(double largest) {
  const double decade = std::log10(largest);
  return decade >= -1.0 && decade < 4.0 ? 0 : 3 * static_cast<int>(std::floor(decade / 3.0));
}

/// "10⁻³ rad/(N m)".
std::string scaled_unit(int exponent, const std::string& unit) {
  return exponent == 0 ? unit : fmt::format("{} {}", decade_label(exponent, false), unit);
}

/// Two or three round numbers across [from, to].
std::vector<Tick> round_ticks(double from, double to) {
  const double raw = (to - from) / 2.4;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  double step = decade;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (factor * decade <= raw) step = factor * decade;
  }
  std::vector<Tick> ticks;
  for (double k = std::ceil(from / step); k * step <= to; k += 1.0) {
    // 12 digits: k step is a round number but for its last bits.
    std::string text = fmt::format("{:.12g}", k * step);
    if (text.starts_with('-')) text = "−" + text.substr(1);
    ticks.push_back({k * step, k == 0.0 ? "0" : text});
  }
  return ticks;
}

}  // namespace

Panel EqualAxes::panel(std::string title) const {
  const int exponent = exponent_for(largest);
  const std::complex<double> middle = drawn(centre);
  const double side = half_side * std::pow(10.0, -exponent);
  const auto axis = [&](const char* part, double at) {
    return Axis{.label = fmt::format("{} {}", part, quantity),
                .unit = scaled_unit(exponent, unit),
                .minimum = at - side,
                .maximum = at + side,
                .ticks = round_ticks(at - side, at + side)};
  };
  Panel panel;
  panel.title = std::move(title);
  panel.x = axis("Re", middle.real());
  panel.y = axis("Im", middle.imag());
  add_coordinate_axes(panel, *panel.x->minimum, *panel.x->maximum, *panel.y.minimum,
                      *panel.y.maximum);
  return panel;
}

std::complex<double> EqualAxes::drawn(std::complex<double> value) const {
  return value * std::pow(10.0, -exponent_for(largest));
}

Series EqualAxes::series(std::string name, std::span<const std::complex<double>> values,
                         const Style& style) const {
  Series series{std::move(name), {}, {}, style};
  for (const auto& value : values) {
    const std::complex<double> point = drawn(value);
    series.x.push_back(point.real());
    series.y.push_back(point.imag());
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
