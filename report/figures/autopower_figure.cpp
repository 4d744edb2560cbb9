#include "report/figures/autopower_figure.hpp"

#include "report/figures/feature_marks.hpp"
#include "report/figures/measured_curve.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace flexarm::report {
namespace {

constexpr int kAutopowerWidth_px = 1000;
constexpr int kAutopowerFurniture_px = 110;  // title and frequency axis
constexpr int kAutopowerPanel_px = 190;      // with the panel's title
constexpr double kTorqueHeight = 0.75;
constexpr double kLabelRoom = 0.2;  // for a line of labels above and below

/// "rad²/Hz", "(m/s²)²/Hz", "1/Hz".
std::string density_unit(std::string_view unit) {
  if (unit == "1") return "1/Hz";
  const bool single = unit.find_first_of(" /^") == std::string_view::npos;
  return unit_text(single ? fmt::format("{}^2/Hz", unit) : fmt::format("({})^2/Hz", unit));
}

/// Lines above 0 Hz.
Panel spectrum_panel(const std::string& title, std::string_view unit,
                     const std::vector<double>& frequency_Hz, const std::vector<double>& density) {
  if (density.size() != frequency_Hz.size()) {
    throw std::invalid_argument(fmt::format("{}: {} densities at {} frequencies", title,
                                            density.size(), frequency_Hz.size()));
  }
  const auto first = std::ranges::upper_bound(frequency_Hz, 0.0) - frequency_Hz.begin();
  Panel panel;
  panel.title = title;
  panel.y = {.label = "density", .unit = density_unit(unit), .scale = Scale::logarithmic};
  panel.series.push_back(measured_curve("autopower spectral density",
                                        {frequency_Hz.begin() + first, frequency_Hz.end()},
                                        {density.begin() + first, density.end()}));
  return panel;
}

bool has_power(const std::vector<double>& density) {
  return std::ranges::any_of(density,
                             [](double value) { return std::isfinite(value) && value > 0.0; });
}

}  // namespace

Figure autopower_figure(const measured::FrequencyResponseEstimate& estimate,
                        std::span<const measured::SensorFeatures> features,
                        const AutopowerPlot& plot) {
  PanelStack stack;
  stack.x = {.label = "frequency", .unit = "Hz", .scale = plot.frequency_scale};
  const auto& frequency_Hz = estimate.frequency_Hz;
  std::vector<double> poles_Hz;
  for (const double pole_Hz : plot.analytical_poles_Hz) {
    if (!frequency_Hz.empty() && pole_Hz > 0.0 && pole_Hz <= frequency_Hz.back()) {
      poles_Hz.push_back(pole_Hz);
    }
  }
  if (has_power(estimate.input_autopower)) {
    stack.panels.push_back(spectrum_panel("torque", "N m", frequency_Hz, estimate.input_autopower));
    stack.panels.back().height = kTorqueHeight;
    fix_limits(stack.panels.back(), kLabelRoom);
  }
  for (const auto& channel : estimate.channels) {
    if (!has_power(channel.autopower)) continue;
    Panel panel = spectrum_panel(sensor_label(channel.sensor), arm::unit(channel.sensor),
                                 frequency_Hz, channel.autopower);
    fix_limits(panel, kLabelRoom);
    add_frequency_lines(panel, poles_Hz, "analytical pole", analytical_pole_style());
    const auto found =
        std::ranges::find(features, channel.sensor, &measured::SensorFeatures::sensor);
    if (found != features.end()) {
      add_feature_marks(panel, found->autopower, FeatureLevel::power);
    }
    stack.panels.push_back(std::move(panel));
  }
  if (stack.panels.empty()) {
    throw std::invalid_argument(fmt::format("\"{}\": no spectrum to draw", plot.title));
  }
  Figure figure{.title = plot.title, .width_px = kAutopowerWidth_px};
  figure.height_px =
      kAutopowerFurniture_px + kAutopowerPanel_px * static_cast<int>(stack.panels.size());
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
