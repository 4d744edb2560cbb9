#include "report/figures/separation_figure.hpp"

#include "report/figures/equal_axes.hpp"
#include "report/tables/plan_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <utility>

namespace flexarm::report {

namespace {

constexpr int kEffectHeight_px = 22;
constexpr int kFrameHeight_px = 130;
constexpr int kFrameWidth_px = 520;  // with the effects' names and the legend

/// One series a kind of separation, in the order of the legend.
std::array<Series, 3> separation_series() {
  std::array<Series, 3> all;
  all[0] = {"indistinguishable", {}, {}, marker_style(purple, Marker::filled_square, 1.6)};
  all[1] = {"weakly distinguishable", {}, {}, marker_style(orange, Marker::filled_square, 1.2)};
  all[2] = {"distinguishable", {}, {}, marker_style(sky_blue, Marker::disc, 0.5)};
  return all;
}

}  // namespace

Figure separation_figure(const diagnose::Plan& plan) {
  const std::size_t count = plan.effects.size();
  auto all = separation_series();
  Panel panel;
  panel.x = Axis{
      .label = "alternative effect", .minimum = 0.0, .maximum = static_cast<double>(count) + 1.0};
  panel.y = {
      .label = "effect present", .minimum = 0.0, .maximum = static_cast<double>(count) + 1.0};
  for (std::size_t a = 0; a < count; ++a) {
    // The first effect is the uppermost row, as in the text.
    const double y = static_cast<double>(count - a);
    const std::string letter = effect_letter(a);
    panel.x->ticks.push_back({static_cast<double>(a) + 1.0, letter});
    panel.y.ticks.push_back(
        {y, fmt::format("{}  {}", in_words(plan.effects[a].hypothesis.label()), letter)});
    for (std::size_t b = 0; b < count; ++b) {
      const auto& separation = plan.separations[a][b];
      if (!separation) continue;
      const std::size_t kind = separation->lead < diagnose::kToldLead ? 0
                               : separation->lead < kClearLead        ? 1
                                                                      : 2;
      all[kind].x.push_back(static_cast<double>(b) + 1.0);
      all[kind].y.push_back(y);
    }
  }
  for (Series& series : all) {
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  }
  const int side_px = kEffectHeight_px * static_cast<int>(count + 1);
  Figure figure;
  figure.title = "Distinguishability of effects in the planned runs";
  figure.stacks.push_back({.panels = {std::move(panel)}});
  figure.width_px = side_px + kFrameWidth_px;
  figure.height_px = side_px + kFrameHeight_px;
  return figure;
}

}  // namespace flexarm::report
