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
constexpr double kRoomAroundCircle = 1.12;
constexpr double kRoomAroundLocus = 1.08;
constexpr int kMostDecades = 4;

bool is_value_shown(const Complex& value) {
  return std::isfinite(std::abs(value)) && value != 0.0;
}

constexpr const char* kPoleName = "pole frequency";
constexpr const char* kHalfPowerName = "half-power points";
constexpr const char* kNegativeName = "negative frequencies";
constexpr const char* kMinusOneName = "−1";
const Style kLocus{.colour = kBaselineColour, .line_width_px = 1.6};
const Style kAtPole = marker_style(kPoleColour, Marker::disc, 0.9);
const Style kNegative{.colour = kBaselineColour, .tint = 0.4, .line = Line::dashed};
const Style kMinusOne = marker_style(black, Marker::plus, 1.2);
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
  const double shown = plot.marks.minus_one ? std::max(largest, 1.0) : largest;
  const double half_side = kRoomAroundLocus * compressed.modulus(shown);

  Panel panel;
  panel.title = "all frequencies, modulus compressed";
  const auto axis = [&](const char* label) {
    Axis made{.label = label, .unit = plot.unit, .minimum = -half_side, .maximum = half_side};
    made.ticks = {{0.0, "0"}};
    for (int exponent = static_cast<int>(std::ceil(std::log10(compressed.g0)));
         std::pow(10.0, exponent) <= shown * kRoomAroundLocus; ++exponent) {
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
  if (plot.marks.negative_frequencies) {
    Series negative{kNegativeName, locus.x, locus.y, kNegative};
    for (double& imaginary : negative.y) imaginary = -imaginary;
    panel.series.push_back(std::move(negative));
  }
  panel.series.push_back(std::move(locus));
  if (plot.marks.minus_one) {
    panel.series.push_back({kMinusOneName, {compressed(-1.0).real()}, {0.0}, kMinusOne});
  }
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
  const std::array half_power = {circle.below, circle.above};
  Complex low = circle.at_pole;
  Complex high = circle.at_pole;
  const auto enclose = [&](const Complex& value) {
    low = {std::fmin(low.real(), value.real()), std::fmin(low.imag(), value.imag())};
    high = {std::fmax(high.real(), value.real()), std::fmax(high.imag(), value.imag())};
  };
  std::ranges::for_each(circle.values, enclose);
  std::ranges::for_each(half_power, enclose);
  const Complex size = high - low;
  const EqualAxes axes{"G", plot.unit, (low + high) / 2.0,
                       kRoomAroundCircle * std::max(size.real(), size.imag()) / 2.0};
  Panel panel = axes.panel(circle.label);
  panel.series.push_back(complex_series("response", circle.values, kLocus));
  panel.series.push_back(complex_series(kPoleName, {&circle.at_pole, 1}, kAtPole));
  panel.series.push_back(complex_series(kHalfPowerName, half_power, kAtHalfPower));
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
  if (plot.marks.negative_frequencies) figure.legend.push_back({kNegativeName, kNegative});
  if (plot.marks.minus_one) figure.legend.push_back({kMinusOneName, kMinusOne});
  return figure;
}

}  // namespace flexarm::report
