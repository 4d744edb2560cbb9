#include "report/figures/nyquist_circle_figure.hpp"

#include "report/figures/equal_axes.hpp"
#include "report/figures/meaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kColumns = 3;
constexpr int kLegend_px = 190;
constexpr int kColumn_px = 390;
constexpr int kCircleRow_px = 390;
constexpr double kCircleRoom = 1.25;  // half side over radius
constexpr double kTextAway = 0.35;    // of the centre, in radii, on the far side of the resonance
constexpr std::size_t kMostPoints = 500;
constexpr int kCircleSteps = 180;

const Style kPoints = marker_style(kMeasuredColour, Marker::disc, 0.45);
const Style kCircle{.colour = kIdentifiedColour, .line_width_px = 1.2};
const Style kNatural = marker_style(kIdentifiedColour, Marker::filled_diamond, 0.8);
const Style kHalfPower = marker_style(kIdentifiedColour, Marker::square, 0.8);

/// Of the velocity form: "rad/s/(N m)".
std::string velocity_unit(const arm::Sensor& sensor) {
  const std::string_view unit = arm::unit(sensor);
  switch (arm::derivative_order(sensor)) {
    case 0:
      return fmt::format("{}/s/(N m)", unit);
    case 1:
      return fmt::format("{}/(N m)", unit);
    default:  // "m/s^2" is an acceleration's
      return fmt::format("{}/(N m)", unit.substr(0, unit.find('^')));
  }
}

/// Towards the centre from a point of the circle that lies in that direction from it.
TextPlace inwards(Complex direction) {
  if (std::abs(direction.real()) >= std::abs(direction.imag())) {
    return direction.real() > 0.0 ? TextPlace::left : TextPlace::right;
  }
  return direction.imag() > 0.0 ? TextPlace::below : TextPlace::above;
}

Panel circle_panel(const measured::NyquistCircle& resonance, const std::string& unit) {
  const auto& [centre, radius] = std::pair(resonance.circle.centre, resonance.circle.radius);
  if (!(radius > 0.0)) {
    throw std::invalid_argument(fmt::format("circle {}: a radius of {}", resonance.order, radius));
  }
  const EqualAxes axes{"V", unit, centre, kCircleRoom * radius};
  Panel panel = axes.panel(fmt::format("resonance at {:#.6g} Hz", resonance.natural_frequency_Hz));

  std::vector<Complex> around;
  for (int k = 0; k <= kCircleSteps; ++k) {
    around.push_back(centre + std::polar(radius, 2.0 * std::numbers::pi * k / kCircleSteps));
  }
  panel.series.push_back(complex_series("fitted circle", around, kCircle));
  const std::size_t step = (resonance.velocity.size() + kMostPoints - 1) / kMostPoints;
  std::vector<Complex> points;
  for (std::size_t k = 0; k < resonance.velocity.size(); k += step) {
    points.push_back(resonance.velocity[k]);
  }
  if (!points.empty()) panel.series.push_back(complex_series("measured", points, kPoints));

  // The angle at the centre from the resonance is -2 atan q: a quarter turn at half power.
  const double zeta = resonance.damping_ratio;
  const double f_Hz = resonance.natural_frequency_Hz;
  const Complex natural = std::polar(1.0, std::arg(resonance.modal_constant));
  const std::array directions = {natural, natural * Complex(0.0, 1.0),
                                 natural * Complex(0.0, -1.0)};
  const std::array frequencies_Hz = {f_Hz, f_Hz * (std::sqrt(1.0 + zeta * zeta) - zeta),
                                     f_Hz * (std::sqrt(1.0 + zeta * zeta) + zeta)};
  std::vector<Complex> marks;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    marks.push_back(centre + radius * directions[k]);
    const Complex at = marks.back();
    panel.annotations.push_back({at.real(), at.imag(), fmt::format("{:#.5g} Hz", frequencies_Hz[k]),
                                 inwards(directions[k])});
  }
  panel.series.push_back(complex_series("natural frequency", std::span(marks).first(1), kNatural));
  panel.series.push_back(
      complex_series("half-power points", std::span(marks).subspan(1), kHalfPower));

  const Complex text = centre - kTextAway * radius * natural;
  panel.annotations.push_back(
      {text.real(), text.imag(), fmt::format("ζ = {:#.4g}", zeta), TextPlace::centre});
  return panel;
}

}  // namespace

Figure nyquist_circle_figure(const arm::Sensor& sensor,
                             std::span<const measured::NyquistCircle> circles,
                             const std::string& title) {
  if (circles.empty()) {
    throw std::invalid_argument(fmt::format("{}: no circle to draw", arm::to_string(sensor)));
  }
  const std::size_t columns = std::min(circles.size(), kColumns);
  const std::size_t rows = (circles.size() + columns - 1) / columns;
  Figure figure{.title = title};
  figure.width_px = kLegend_px + kColumn_px * static_cast<int>(columns);
  figure.height_px = kCircleRow_px * static_cast<int>(rows) + (title.empty() ? 0 : 30);
  for (std::size_t column = 0; column < columns; ++column) {
    PanelStack stack{.square = true};
    for (std::size_t i = column; i < circles.size(); i += columns) {
      stack.panels.push_back(circle_panel(circles[i], velocity_unit(sensor)));
    }
    stack.blank_panels = static_cast<int>(rows - stack.panels.size());
    figure.stacks.push_back(std::move(stack));
  }
  return figure;
}

}  // namespace flexarm::report
