#include "report/figures/axis_units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace flexarm::report {
namespace {

constexpr std::string_view kOverTwoPi = "/2π";  // of "|s|/2π"

double to_rad_per_s(double frequency_Hz) {
  return 2.0 * std::numbers::pi * frequency_Hz;
}

double to_decibel(double magnitude) {
  return 20.0 * std::log10(magnitude);
}

using Conversion = double (*)(double);

void convert(Axis& axis, Conversion conversion) {
  for (auto* limit : {&axis.minimum, &axis.maximum}) {
    if (*limit) *limit = conversion(**limit);
  }
}

/// Whether an axis is in Hz, which it is not afterwards.
bool take_hertz(Axis& axis) {
  if (axis.unit != "Hz") return false;
  axis.unit = "rad/s";
  if (axis.label.ends_with(kOverTwoPi)) axis.label.resize(axis.label.size() - kOverTwoPi.size());
  convert(axis, to_rad_per_s);
  return true;
}

bool take_magnitude(Axis& axis) {
  if (axis.label != kMagnitude || axis.scale != Scale::logarithmic) return false;
  axis.unit = fmt::format("dB re {}{}", axis.unit.starts_with("1/") ? "" : "1 ", axis.unit);
  axis.scale = Scale::linear;
  convert(axis, to_decibel);
  return true;
}

void convert_x(Panel& panel, Conversion conversion) {
  for (Series& series : panel.series) {
    for (double& x : series.x) x = conversion(x);
  }
  for (Annotation& annotation : panel.annotations) {
    annotation.x = conversion(annotation.x);
    if (!annotation.frequency_Hz) continue;
    annotation.text = frequency_text(conversion(*annotation.frequency_Hz));
  }
}

void convert_y(Panel& panel, Conversion conversion) {
  for (Series& series : panel.series) {
    for (double& y : series.y) y = conversion(y);
    for (double& y : series.y_to) y = conversion(y);
  }
  for (Annotation& annotation : panel.annotations) annotation.y = conversion(annotation.y);
}

}  // namespace

std::string frequency_text(double frequency) {
  return fmt::format("{:#.4g}", frequency);
}

Figure in_units(Figure figure, MagnitudeScale magnitude, FrequencyUnit frequency) {
  const bool is_in_radians = frequency == FrequencyUnit::radians_per_second;
  for (PanelStack& stack : figure.stacks) {
    const bool is_common_hertz = is_in_radians && take_hertz(stack.x);
    for (Panel& panel : stack.panels) {
      if (panel.x ? is_in_radians && take_hertz(*panel.x) : is_common_hertz) {
        convert_x(panel, to_rad_per_s);
      }
      if (is_in_radians && take_hertz(panel.y)) convert_y(panel, to_rad_per_s);
      if (magnitude == MagnitudeScale::decibel && take_magnitude(panel.y)) {
        convert_y(panel, to_decibel);
      }
    }
  }
  return figure;
}

}  // namespace flexarm::report
