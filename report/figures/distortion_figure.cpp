#include "report/figures/distortion_figure.hpp"

#include "report/figures/equal_axes.hpp"
#include "report/figures/meaning.hpp"
#include "report/figures/sensor_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace flexarm::report {
namespace {

constexpr int kDistortionWidth_px = 1000;
constexpr int kDistortionHeight_px = 520;

/// "found: −41.2 dB".
std::string verdict(const measured::DistortionTest& test) {
  if (test.lines == 0) return "not tested";
  if (!test.found) return "not significant";
  if (!std::isfinite(test.level_dB)) return "significant";
  return fmt::format("significant: {}{:.1f} dB", test.level_dB < 0.0 ? "−" : "",
                     std::abs(test.level_dB));
}

}  // namespace

Figure distortion_figure(const arm::Sensor& sensor, const measured::ChannelDistortion& channel,
                         const std::string& title, Scale frequency_scale) {
  const bool drawable = std::ranges::any_of(
      channel.lines, [](const measured::DistortionLine& line) { return line.amplitude > 0.0; });
  if (!drawable) {
    throw std::invalid_argument(
        fmt::format("{}: no spectral line to draw", arm::to_string(sensor)));
  }
  Panel panel;
  panel.y = {.label = "amplitude", .unit = axis_unit(sensor), .scale = Scale::logarithmic};
  Figure figure{.title = title, .width_px = kDistortionWidth_px, .height_px = kDistortionHeight_px};
  const auto add = [&](Series series, const std::string& remark) {
    if (series.x.empty()) return;
    figure.legend.push_back({series.name, series.style});
    if (!remark.empty()) figure.legend.push_back({remark, {}});
    panel.series.push_back(std::move(series));
  };

  Series noise{"noise", {}, {}, {.colour = grey, .line_width_px = 1.2}};
  for (const auto& line : channel.lines) {
    noise.x.push_back(line.frequency_Hz);
    noise.y.push_back(line.noise_std);
  }
  add(std::move(noise), "standard deviation");
  const auto add_lines = [&](measured::LineKind kind, const char* name, const Style& style,
                             const std::string& remark) {
    Series series{name, {}, {}, style};
    for (const auto& line : channel.lines) {
      if (line.kind != kind) continue;
      series.x.push_back(line.frequency_Hz);
      series.y.push_back(line.amplitude);
    }
    add(std::move(series), remark);
  };
  using measured::LineKind;
  add_lines(LineKind::odd, "odd detection lines", marker_style(orange, Marker::triangle, 0.5),
            verdict(channel.odd));
  add_lines(LineKind::even, "even detection lines", marker_style(green, Marker::square, 0.45),
            verdict(channel.even));
  add_lines(LineKind::driven, "excited lines", marker_style(kMeasuredColour, Marker::disc, 0.5),
            "");

  PanelStack stack;
  stack.x = {.label = "frequency", .unit = "Hz", .scale = frequency_scale};
  stack.panels.push_back(std::move(panel));
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
