#include "report/figures/hub_law_figure.hpp"

#include "report/figures/meaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace flexarm::report {

namespace {

constexpr double kLawStdErrors = 2.0;
constexpr int kLawFigureWidth_px = 900;
constexpr int kLawFigureHeight_px = 520;
constexpr int kLawFurniture_px = 110;
constexpr int kLawPanel_px = 190;

/// The column of a table over angle and velocity, or all of another one.
std::vector<double> curve_of(const diagnose::EmpiricalLaw& law, const std::vector<double>& values,
                             std::size_t curve) {
  if (law.means.size() < 2) return values;
  std::vector<double> made;
  for (std::size_t i = curve; i < values.size(); i += law.table.columns()) {
    made.push_back(values[i]);
  }
  return made;
}

Panel law_panel(const diagnose::EmpiricalLaw& law, std::size_t curve) {
  const auto& axis =
      law.table.angle_rad.empty() ? law.table.velocity_rad_per_s : law.table.angle_rad;
  const std::vector<double> torque_N_m = curve_of(law, law.table.torque_N_m, curve);
  const std::vector<double> std_error_N_m = curve_of(law, law.std_errors_N_m, curve);
  Panel panel{.y = {.label = "hub torque", .unit = "N m"}};
  Series interval{"law ± 2 standard errors",
                  axis,
                  {},
                  {.colour = kIdentifiedColour, .tint = 0.7, .line = Line::none, .filled = true}};
  for (std::size_t i = 0; i < axis.size(); ++i) {
    interval.y.push_back(torque_N_m[i] - kLawStdErrors * std_error_N_m[i]);
    interval.y_to.push_back(torque_N_m[i] + kLawStdErrors * std_error_N_m[i]);
  }
  Series bars{
      "mean ± 2 standard errors", {}, {}, {.colour = kMeasuredColour, .line_width_px = 1.5}};
  Series means{
      "mean residual hub torque",
      {},
      {},
      {.colour = kMeasuredColour, .line = Line::none, .marker = Marker::disc, .marker_size = 0.5}};
  for (const diagnose::TorqueMean& mean : law.means[curve]) {
    for (const double side : {-kLawStdErrors, kLawStdErrors}) {
      bars.x.push_back(mean.at);
      bars.y.push_back(mean.torque_N_m + side * mean.std_error_N_m);
    }
    bars.x.push_back(mean.at);
    bars.y.push_back(kNotDrawn);
    means.x.push_back(mean.at);
    means.y.push_back(mean.torque_N_m);
  }
  panel.series.push_back(std::move(interval));
  panel.series.push_back(
      {"empirical law", axis, torque_N_m, {.colour = kIdentifiedColour, .line_width_px = 2.0}});
  if (!means.x.empty()) {
    panel.series.push_back(std::move(bars));
    panel.series.push_back(std::move(means));
  }
  return panel;
}

/// A filled area within limits, with further points where its sides cross them.
Series clipped(const Series& area, double low, double high) {
  Series made{area.name, {}, {}, area.style};
  const auto add = [&](std::size_t i, double part) {
    const auto between = [&](const std::vector<double>& values) {
      return part > 0.0 ? std::lerp(values[i], values[i + 1], part) : values[i];
    };
    made.x.push_back(between(area.x));
    made.y.push_back(std::clamp(between(area.y), low, high));
    made.y_to.push_back(std::clamp(between(area.y_to), low, high));
  };
  for (std::size_t i = 0; i < area.x.size(); ++i) {
    add(i, 0.0);
    if (i + 1 == area.x.size()) break;
    std::set<double> crossings;
    for (const auto* side : {&area.y, &area.y_to}) {
      for (const double limit : {low, high}) {
        const double part = (limit - (*side)[i]) / ((*side)[i + 1] - (*side)[i]);
        if (part > 0.0 && part < 1.0) crossings.insert(part);
      }
    }
    for (const double part : crossings) add(i, part);
  }
  return made;
}

/// Gives all panels one range, that of laws and means. Intervals end at its limits: one of a place
/// that no sample is near would set the scale.
void share_range(std::vector<Panel>& panels) {
  double low = 0.0;
  double high = 0.0;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) {
      if (series.style.filled) continue;
      for (const double value : series.y) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
  }
  constexpr double kMargin = 0.25;
  const double margin = high > low ? kMargin * (high - low) : 1.0;
  for (Panel& panel : panels) {
    panel.y.minimum = low - margin;
    panel.y.maximum = high + margin;
    for (Series& series : panel.series) {
      if (series.style.filled) series = clipped(series, *panel.y.minimum, *panel.y.maximum);
    }
  }
}

}  // namespace

Figure hub_law_figure(const diagnose::EmpiricalLaw& law) {
  Figure figure{.title = "Empirical law of hub torque",
                .width_px = kLawFigureWidth_px,
                .height_px = kLawFigureHeight_px};
  PanelStack stack;
  stack.x = law.table.angle_rad.empty() ? Axis{.label = "hub velocity", .unit = "rad/s"}
                                        : Axis{.label = "hub angle", .unit = "rad"};
  for (std::size_t curve = 0; curve < law.means.size(); ++curve) {
    stack.panels.push_back(law_panel(law, curve));
    if (law.means.size() < 2) continue;
    stack.panels.back().title =
        fmt::format("hub velocity {:.3g} rad/s", law.table.velocity_rad_per_s[curve]);
  }
  share_range(stack.panels);
  if (law.means.size() > 1) {
    figure.height_px = kLawFurniture_px + kLawPanel_px * static_cast<int>(law.means.size());
  }
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
