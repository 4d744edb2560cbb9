#include "report/figures/missing_force_figure.hpp"

#include "report/figures/equal_axes.hpp"
#include "report/figures/meaning.hpp"
#include "report/tables/missing_force_table.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace flexarm::report {

namespace {

constexpr int kForceFigureWidth_px = 1000;
constexpr int kForceFurniture_px = 150;  // titles and axes
constexpr int kForceSpectrum_px = 280;
constexpr int kPortRow_px = 26;

/// A step a band: what is constant over it, and a gap where a band is left out.
Panel force_spectrum_panel(const diagnose::PortShare& port, const diagnose::ForceSize& size) {
  Panel panel{.title = fmt::format("{} ({})", in_words(port_name(port)), in_words(port.place)),
              .x = Axis{.label = "frequency", .unit = "Hz", .scale = Scale::logarithmic},
              .y = {.label = "RMS in third octaves", .unit = unit_text(size.unit), .minimum = 0.0}};
  Series interval{"± 2 standard errors",
                  {},
                  {},
                  {.colour = kIdentifiedColour, .tint = 0.7, .line = Line::none, .filled = true}};
  Series value{"missing force", {}, {}, {.colour = kIdentifiedColour}};
  double largest = 0.0;
  double above_Hz = 0.0;
  for (const diagnose::ForceBand& band : size.spectrum) {
    if (above_Hz > 0.0 && band.from_Hz > 1.01 * above_Hz) {
      value.x.push_back(band.from_Hz);
      value.y.push_back(kNotDrawn);
      interval.x.push_back(band.from_Hz);
      interval.y.push_back(kNotDrawn);
      interval.y_to.push_back(kNotDrawn);
    }
    above_Hz = band.to_Hz;
    for (const double edge_Hz : {band.from_Hz, band.to_Hz}) {
      value.x.push_back(edge_Hz);
      value.y.push_back(band.rms());
      interval.x.push_back(edge_Hz);
      interval.y.push_back(band.rms_at(-diagnose::kDistance));
      interval.y_to.push_back(band.rms_at(diagnose::kDistance));
    }
    largest = std::max(largest, band.rms_at(diagnose::kDistance));
  }
  panel.y.maximum = largest > 0.0 ? 1.08 * largest : 1.0;
  panel.x->minimum = size.spectrum.front().from_Hz;
  panel.x->maximum = size.spectrum.back().to_Hz;
  if (size.std_error) panel.series.push_back(std::move(interval));
  panel.series.push_back(std::move(value));
  return panel;
}

Panel shares_panel(const diagnose::MissingForce& force) {
  const auto count = static_cast<double>(force.ports.size());
  Panel panel{.title = "by port",
              .x = Axis{.label = "explained share of the excess residual",
                        .unit = "%",
                        .minimum = 0.0,
                        .maximum = 100.0},
              .y = {.minimum = 0.0, .maximum = count + 1.0}};
  Series bars{"± 2 standard errors", {}, {}, {.colour = grey, .line_width_px = 1.5}};
  std::array<Series, 2> shares;
  shares[0] = {"port stated", {}, {}, marker_style(kIdentifiedColour, Marker::filled_square, 1.0)};
  shares[1] = {"port not stated", {}, {}, marker_style(grey, Marker::circle, 1.0)};
  for (std::size_t i = 0; i < force.ports.size(); ++i) {
    const diagnose::PortShare& port = force.ports[i];
    const double y = count - static_cast<double>(i);
    panel.y.ticks.push_back({y, in_words(port_name(port))});
    for (const double side : {-diagnose::kDistance, diagnose::kDistance}) {
      bars.x.push_back(explained_percent(port.share + side * port.std_error));
      bars.y.push_back(y);
    }
    bars.x.push_back(bars.x.back());
    bars.y.push_back(kNotDrawn);
    Series& own = shares[i < force.stated ? 0 : 1];
    own.x.push_back(explained_percent(port.share));
    own.y.push_back(y);
  }
  constexpr double kLeast_percent = 100.0 * diagnose::kLeastPortShare;
  panel.series.push_back({"least share of a stated port",
                          {kLeast_percent, kLeast_percent},
                          {0.0, count + 1.0},
                          thin_line(grey, Line::dashed)});
  panel.series.push_back(std::move(bars));
  for (Series& own : shares) {
    if (!own.x.empty()) panel.series.push_back(std::move(own));
  }
  return panel;
}

}  // namespace

Figure missing_force_figure(const diagnose::MissingForce& force) {
  const int shares_px = kPortRow_px * static_cast<int>(force.ports.size() + 1);
  Figure figure{.title = "Missing force",
                .width_px = kForceFigureWidth_px,
                .height_px = kForceFurniture_px + shares_px};
  PanelStack stack;
  if (force.size) {
    stack.panels.push_back(force_spectrum_panel(force.ports.front(), *force.size));
    stack.panels.back().height = static_cast<double>(kForceSpectrum_px) / shares_px;
    figure.height_px += kForceSpectrum_px;
  }
  stack.panels.push_back(shares_panel(force));
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
