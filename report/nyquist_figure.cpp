#include "report/nyquist_figure.hpp"

#include "report/logarithmic_ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;

constexpr int kWidth_px = 1400;
constexpr int kHeight_px = 660;
constexpr double kLocusWidth = 2.3;  // relative to a circle's, so that it fills the height
constexpr std::size_t kMostCircles = 4;
constexpr std::size_t kCirclesInAColumn = 2;
constexpr double kRoomAroundCircle = 0.66;  // half side over diameter
constexpr double kRoomAroundLocus = 1.08;
constexpr int kMostDecades = 4;

bool is_shown(const Complex& value) {
  return std::isfinite(std::abs(value)) && value != 0.0;
}

Style thin(int colour, Line line = Line::solid) {
  Style style;
  style.colour = colour;
  style.line = line;
  style.line_width_px = 0.8;
  return style;
}

Style point(int colour, Marker marker, double size) {
  Style style;
  style.colour = colour;
  style.line = Line::none;
  style.marker = marker;
  style.marker_size = size;
  return style;
}

constexpr const char* kPoleName = "pole's frequency";
constexpr const char* kHalfPowerName = "half power";
constexpr double kTextLeft = 0.3;  // of the centre, in diameters
const Style kLocus{.colour = blue, .line_width_px = 1.6};
const Style kAtPole = point(vermillion, Marker::disc, 0.9);
const Style kHalfPower = point(vermillion, Marker::circle, 0.9);

/// Real and imaginary axis across a panel.
void add_axes(Panel& panel, double left, double right, double bottom, double top) {
  panel.series.push_back({"", {left, right}, {0.0, 0.0}, thin(grey)});
  panel.series.push_back({"", {0.0, 0.0}, {bottom, top}, thin(grey)});
}

/// log10(1 + |G|/g0), with the angle of G.
struct Compressed {
  double g0 = 1.0;

  double modulus(double size) const { return std::log10(1.0 + size / g0); }
  Complex operator()(const Complex& value) const {
    return std::polar(modulus(std::abs(value)), std::arg(value));
  }
};

Series circle_around_origin(double radius) {
  Series series{"", {}, {}, thin(grey, Line::dashed)};
  series.style.tint = 0.45;
  for (int degree = 0; degree <= 360; degree += 3) {
    series.x.push_back(radius * std::cos(degree * std::numbers::pi / 180.0));
    series.y.push_back(radius * std::sin(degree * std::numbers::pi / 180.0));
  }
  return series;
}

PanelStack whole_locus(const NyquistPlot& plot) {
  std::vector<double> sizes;
  for (const auto& value : plot.response) {
    if (is_shown(value)) sizes.push_back(std::abs(value));
  }
  if (sizes.empty()) {
    throw std::invalid_argument(fmt::format("\"{}\": no value to draw", plot.title));
  }
  // The lower quartile keeps deep notches from blowing up what lies between them and the peaks.
  std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 4));
  const double quartile = sizes[sizes.size() / 4];
  const double largest = *std::ranges::max_element(sizes);
  const Compressed compressed{std::max(quartile, largest * std::pow(10.0, -kMostDecades))};
  const double half_side = kRoomAroundLocus * compressed.modulus(largest);

  Panel panel;
  panel.title = "all frequencies, modulus compressed";
  const auto axis = [&](const char* label) {
    Axis made{.label = label, .unit = plot.unit, .minimum = -half_side, .maximum = half_side};
    made.ticks = {{0.0, "0"}};
    for (int exponent = static_cast<int>(std::ceil(std::log10(compressed.g0)));
         std::pow(10.0, exponent) <= largest * kRoomAroundLocus; ++exponent) {
      const double size = std::pow(10.0, exponent);
      const std::string text = decade_label(exponent, exponent >= 0 && exponent <= 4);
      made.ticks.push_back({compressed.modulus(size), text});
      made.ticks.insert(made.ticks.begin(), {-compressed.modulus(size), "−" + text});
    }
    return made;
  };
  panel.y = axis("Im G");
  for (const Tick& tick : panel.y.ticks) {
    if (tick.position > 0.0) panel.series.push_back(circle_around_origin(tick.position));
  }
  add_axes(panel, -half_side, half_side, -half_side, half_side);
  Series locus{"response", {}, {}, kLocus};
  for (const auto& value : plot.response) {
    const Complex drawn = is_shown(value) ? compressed(value)
                                          : Complex(std::numeric_limits<double>::quiet_NaN(), 0.0);
    locus.x.push_back(drawn.real());
    locus.y.push_back(drawn.imag());
  }
  panel.series.push_back(std::move(locus));
  Series poles{kPoleName, {}, {}, kAtPole};
  for (const auto& circle : plot.circles) {
    const Complex drawn = compressed(circle.at_pole);
    poles.x.push_back(drawn.real());
    poles.y.push_back(drawn.imag());
  }
  panel.series.push_back(std::move(poles));
  return {.x = axis("Re G"), .panels = {std::move(panel)}, .width = kLocusWidth, .square = true};
}

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

Panel circle_panel(const NyquistPlot& plot, const NyquistCircle& circle) {
  const double largest =
      std::max({std::abs(circle.at_pole), std::abs(circle.below), std::abs(circle.above)});
  const int exponent = exponent_for(largest);
  const double scale = std::pow(10.0, -exponent);
  const Complex centre = scale * (circle.below + circle.above) / 2.0;
  const double diameter = scale * std::abs(circle.above - circle.below);
  const double half_side = kRoomAroundCircle * diameter;
  const auto axis = [&](const char* label, double middle) {
    return Axis{.label = label,
                .unit = scaled_unit(exponent, plot.unit),
                .minimum = middle - half_side,
                .maximum = middle + half_side,
                .ticks = round_ticks(middle - half_side, middle + half_side)};
  };
  Panel panel;
  panel.title = circle.label;
  panel.x = axis("Re G", centre.real());
  panel.y = axis("Im G", centre.imag());
  add_axes(panel, *panel.x->minimum, *panel.x->maximum, *panel.y.minimum, *panel.y.maximum);
  Series locus{"response", {}, {}, kLocus};
  for (const auto& value : circle.values) {
    locus.x.push_back(scale * value.real());
    locus.y.push_back(scale * value.imag());
  }
  panel.series.push_back(std::move(locus));
  const auto mark = [&](const char* name, std::initializer_list<Complex> values, Style style) {
    Series series{name, {}, {}, style};
    for (const auto& value : values) {
      series.x.push_back(scale * value.real());
      series.y.push_back(scale * value.imag());
    }
    panel.series.push_back(std::move(series));
  };
  mark(kPoleName, {circle.at_pole}, kAtPole);
  mark(kHalfPowerName, {circle.below, circle.above}, kHalfPower);
  panel.annotations.push_back({centre.real() - kTextLeft * diameter, centre.imag(), circle.remark});
  return panel;
}

}  // namespace

Figure nyquist_figure(const NyquistPlot& plot) {
  if (plot.circles.empty()) {
    throw std::invalid_argument(fmt::format("\"{}\": no circle to draw", plot.title));
  }
  Figure figure{.title = plot.title, .width_px = kWidth_px, .height_px = kHeight_px};
  figure.stacks.push_back(whole_locus(plot));
  const std::size_t shown = std::min(plot.circles.size(), kMostCircles);
  const std::size_t rows = std::min(shown, kCirclesInAColumn);
  for (std::size_t i = 0; i < shown; ++i) {
    if (i % rows == 0) figure.stacks.push_back({.square = true});
    figure.stacks.back().panels.push_back(circle_panel(plot, plot.circles[i]));
  }
  auto& last = figure.stacks.back();
  last.blank_panels = static_cast<int>(rows - last.panels.size());
  figure.legend = {{"response", kLocus}, {kPoleName, kAtPole}, {kHalfPowerName, kHalfPower}};
  return figure;
}

}  // namespace flexarm::report
