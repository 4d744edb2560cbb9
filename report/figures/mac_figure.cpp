#include "report/figures/mac_figure.hpp"

#include "report/figures/equal_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace flexarm::report {

namespace {

constexpr int kMacCell_px = 64;
constexpr int kMacFrameHeight_px = 140;
constexpr int kMacFrameWidth_px = 380;  // with the modes' frequencies and the legend

/// One series a class of values, in the order of the legend.
struct MacClass {
  double from;
  Series series;
};

std::array<MacClass, 4> mac_classes() {
  return {{{0.9, {"0.9 to 1", {}, {}, marker_style(green, Marker::filled_square, 2.2)}},
           {0.5, {"0.5 to 0.9", {}, {}, marker_style(sky_blue, Marker::filled_square, 1.7)}},
           {0.1, {"0.1 to 0.5", {}, {}, marker_style(orange, Marker::filled_square, 1.2)}},
           {0.0, {"below 0.1", {}, {}, marker_style(grey, Marker::filled_square, 0.7)}}}};
}

}  // namespace

Figure mac_figure(const compare::ShapeCorrelation& shapes) {
  const std::size_t columns = shapes.model_frequencies_Hz.size();
  const std::size_t rows = shapes.measured.size();
  auto classes = mac_classes();
  Panel panel;
  panel.x =
      Axis{.label = "computed mode", .minimum = 0.4, .maximum = static_cast<double>(columns) + 0.8};
  panel.y = {.label = "measured mode", .minimum = 0.4, .maximum = static_cast<double>(rows) + 0.6};
  for (std::size_t j = 0; j < columns; ++j) {
    panel.x->ticks.push_back({static_cast<double>(j + 1),
                              fmt::format("{}: {:.4g} Hz", j + 1, shapes.model_frequencies_Hz[j])});
  }
  for (std::size_t i = 0; i < rows; ++i) {
    // The first mode is the uppermost row, as in the table.
    const double y = static_cast<double>(rows - i);
    const auto& shape = shapes.measured[i];
    panel.y.ticks.push_back({y, shape.frequency_Hz
                                    ? fmt::format("{}: {:.4g} Hz", shape.order, *shape.frequency_Hz)
                                    : fmt::format("{}", shape.order)});
    for (std::size_t j = 0; j < columns; ++j) {
      const double value = shapes.mac.front()[i][j];
      const auto x = static_cast<double>(j + 1);
      const auto of =
          std::ranges::find_if(classes, [&](const MacClass& one) { return value >= one.from; });
      if (of == classes.end()) continue;  // NaN: a computed shape that is 0 at the sensors
      of->series.x.push_back(x);
      of->series.y.push_back(y);
      panel.annotations.push_back({x + 0.22, y, fmt::format("{:.2f}", value), TextPlace::right});
    }
  }
  for (auto& one : classes) {
    if (!one.series.x.empty()) panel.series.push_back(std::move(one.series));
  }
  Figure figure;
  figure.title = fmt::format("MAC of measured mode shapes and those of {}", shapes.models.front());
  figure.stacks.push_back({.panels = {std::move(panel)}});
  figure.width_px = 2 * kMacCell_px * static_cast<int>(columns) + kMacFrameWidth_px;
  figure.height_px = kMacCell_px * static_cast<int>(rows) + kMacFrameHeight_px;
  return figure;
}

}  // namespace flexarm::report
