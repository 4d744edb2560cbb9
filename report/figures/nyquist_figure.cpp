#include "report/figures/nyquist_figure.hpp"

#include "report/figures/equal_axes.hpp"
#include "report/figures/logarithmic_ticks.hpp"
#include "report/figures/meaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;

constexpr int kNyquistWidth_px = 1400;
constexpr int kNyquistHeight_px = 660;
constexpr double kLocusWidth = 2.3;  // relative to a circle's, so that it fills the height
constexpr std::size_t kMostCircles = 4;
constexpr std::size_t kCirclesInAColumn = 2;
constexpr double kRoomAroundCircle = 0.66;  // half side over diameter
constexpr double kRoomAroundLocus = 1.08;
constexpr int kMostDecades = 4;

bool is_value_shown(const Complex& value) {
  return std::isfinite(std::abs(value)) && value != 0.0;
}

constexpr const char* kPoleName = "pole frequency";
constexpr const char* kHalfPowerName = "half-power points";
constexpr double kTextLeft = 0.3;  // of the centre, in diameters
const Style kLocus{.colour = kBaselineColour, .line_width_px = 1.6};
const Style kAtPole = marker_style(kPoleColour, Marker::disc, 0.9);
const Style kAtHalfPower = marker_style(kPoleColour, Marker::circle, 0.9);

/// log10(1 + |G|/g0), with the angle of G.
struct Compressed {
  double g0 = 1.0;

  double modulus(double size) const { return std::log10(1.0 + size / g0); }
  Complex operator()(const Complex& value) const {
    return std::polar(modulus(std::abs(value)), std::arg(value));
  }
};

Series circle_around_origin(double radius) {
  Series series{"", {}, {}, thin_line(grey, Line::dashed)};
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
    if (is_value_shown(value)) sizes.push_back(std::abs(value));
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
  add_coordinate_axes(panel, -half_side, half_side, -half_side, half_side);
  Series locus{"response", {}, {}, kLocus};
  for (const auto& value : plot.response) {
    const Complex drawn = is_value_shown(value)
                              ? compressed(value)
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

Panel circle_panel(const NyquistPlot& plot, const NyquistCircle& circle) {
  const Complex centre = (circle.below + circle.above) / 2.0;
  const double diameter = std::abs(circle.above - circle.below);
  const EqualAxes axes{"G", plot.unit, centre, kRoomAroundCircle * diameter};
  Panel panel = axes.panel(circle.label);
  panel.series.push_back(complex_series("response", circle.values, kLocus));
  panel.series.push_back(complex_series(kPoleName, {&circle.at_pole, 1}, kAtPole));
  const std::array half_power = {circle.below, circle.above};
  panel.series.push_back(complex_series(kHalfPowerName, half_power, kAtHalfPower));
  const Complex text = centre - kTextLeft * diameter;
  panel.annotations.push_back({text.real(), text.imag(), circle.remark});
  return panel;
}

}  // namespace

Figure nyquist_figure(const NyquistPlot& plot) {
  if (plot.circles.empty()) {
    throw std::invalid_argument(fmt::format("\"{}\": no circle to draw", plot.title));
  }
  Figure figure{.title = plot.title, .width_px = kNyquistWidth_px, .height_px = kNyquistHeight_px};
  figure.stacks.push_back(whole_locus(plot));
  const std::size_t shown = std::min(plot.circles.size(), kMostCircles);
  const std::size_t rows = std::min(shown, kCirclesInAColumn);
  for (std::size_t i = 0; i < shown; ++i) {
    if (i % rows == 0) figure.stacks.push_back({.square = true});
    figure.stacks.back().panels.push_back(circle_panel(plot, plot.circles[i]));
  }
  auto& last = figure.stacks.back();
  last.blank_panels = static_cast<int>(rows - last.panels.size());
  figure.legend = {{"response", kLocus}, {kPoleName, kAtPole}, {kHalfPowerName, kAtHalfPower}};
  return figure;
}

}  // namespace flexarm::report
