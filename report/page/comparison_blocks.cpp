#include "report/page/comparison_blocks.hpp"

#include "compare/damped_roots.hpp"
#include "report/figures/pole_zero_figure.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/page_words.hpp"
#include "report/page/root_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace flexarm::report::page {

namespace {

using compare::Comparison;

/// Relative; roots that are nearer to each other are one point of a map.
constexpr double kVisibleDistance = 1e-6;
constexpr const char* kCoincide = "The other formulations have the same poles and zeros.";
/// Enough roots to show the trend.
constexpr std::array kConvergenceOrders = {1, 2, 3, 5, 10};

std::vector<CurvesPanel> response_comparison(const Comparison& comparison,
                                             const compare::ResponseComparison& response) {
  std::vector<BodeCurve> curves;
  CurvesPanel apart{{"relative difference", "", AxisScale::logarithmic}, 0.9, {}};
  for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
    const std::string name = text_in_words(comparison.subjects[k]);
    curves.push_back({name, numbered_role(k), response.frequency_Hz, response.values[k]});
    if (k == 0) continue;
    auto differences = for_log_axis(response.relative_error[k]);
    if (!has_number(differences)) continue;
    apart.series.push_back(
        curve(name, numbered_role(k), response.frequency_Hz, std::move(differences)));
  }
  auto panels = bode_panels(response_unit(response.sensor), curves);
  if (!panels.empty() && !apart.series.empty()) panels.push_back(std::move(apart));
  return panels;
}

std::string family_name(const compare::FeatureFamily& family) {
  return family.zeros_of ? "zeros of the " + sensor_label(*family.zeros_of) : "poles";
}

bool is_drawn(const compare::RefinementCurve& curve) {
  return std::ranges::find(kConvergenceOrders, curve.order) != kConvergenceOrders.end() &&
         std::ranges::any_of(curve.points,
                             [](const auto& point) { return point.relative_error > 0.0; });
}

Series convergence_series(const compare::RefinementCurve& refined, std::size_t index) {
  std::vector<double> x;
  std::vector<double> y;
  for (const auto& point : refined.points) {
    x.push_back(point.degrees_of_freedom);
    y.push_back(point.relative_error);
  }
  return curve(fmt::format("{} {}", refined.family.zeros_of ? "zero" : "pole", refined.order),
               numbered_role(index), std::move(x), for_log_axis(std::move(y)));
}

void add_formulation(MapBlock& map, const Comparison& comparison, std::size_t k,
                     const arm::Sensor& sensor) {
  const MapSeries series{text_in_words(comparison.subjects[k]), numbered_role(k)};
  std::vector<compare::AnalyticalPole> poles;
  std::vector<std::vector<std::complex<double>>> zeros;
  for (const auto& row : comparison.roots) {
    if (!row.s_rad_per_s[k]) continue;
    const std::complex<double> s = *row.s_rad_per_s[k];
    // Without a damped pair the arm has no damping, or the root was not found with it.
    const auto damped = row.damped.empty() ? std::nullopt : row.damped[k];
    if (!row.damped.empty() && !damped) continue;
    if (!row.family.zeros_of) {
      const auto pole = damped ? compare::natural_frequency(*damped)
                               : compare::NaturalFrequency{std::abs(s) / (2.0 * std::numbers::pi)};
      poles.push_back({pole.frequency_Hz, pole.damping_ratio});
    } else if (*row.family.zeros_of == sensor) {
      zeros.push_back(damped ? compare::with_conjugates(*damped) : with_mirror_images({&s, 1}));
    }
  }
  add_poles(map, series, poles);
  add_zeros(map, series, zeros);
}

}  // namespace

std::vector<std::string> choices_of(const std::vector<NamedArm>& arms,
                                    std::vector<std::string> others) {
  if (arms.size() > 1) others.insert(others.begin(), "arm");
  return others;
}

CurvesView view_of(const NamedArm& arm, std::vector<std::string> labels,
                   std::vector<CurvesPanel> panels) {
  if (!arm.name.empty()) labels.insert(labels.begin(), arm.name);
  return {std::move(labels), {}, std::move(panels)};
}

CurvesBlock comparison_responses(const std::vector<NamedArm>& arms) {
  CurvesBlock block{{"responses", "Frequency responses of the formulations",
                     "Of the damped arm. The lowest panel has the relative difference from the "
                     "exact transfer function."},
                    frequency_axis(),
                    choices_of(arms, {"sensor"}),
                    {}};
  for (const NamedArm& arm : arms) {
    const Comparison& comparison = arm.arm->comparison;
    for (const auto& response : comparison.responses) {
      auto panels = response_comparison(comparison, response);
      if (panels.empty()) continue;
      block.views.push_back(view_of(arm, {sensor_label(response.sensor)}, std::move(panels)));
    }
  }
  return block;
}

CurvesBlock comparison_shapes(const std::vector<NamedArm>& arms) {
  CurvesBlock block{{"shapes", "Displacement of the modes", "Scaled to the total inertia."},
                    {"distance from the hub", "m"},
                    choices_of(arms, {"mode"}),
                    {}};
  for (const NamedArm& arm : arms) {
    const Comparison& comparison = arm.arm->comparison;
    if (comparison.modes.empty()) continue;
    for (std::size_t i = 0; i < comparison.modes.front().size(); ++i) {
      CurvesPanel panel{{"displacement", "m"}, 1.0, {}};
      for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
        if (i >= comparison.modes[k].size()) continue;
        panel.series.push_back(curve(text_in_words(comparison.subjects[k]), numbered_role(k),
                                     comparison.stations_m, comparison.modes[k][i].displacement_m));
      }
      const double f_Hz = comparison.modes.front()[i].omega_rad_per_s / (2.0 * std::numbers::pi);
      block.views.push_back(
          view_of(arm, {fmt::format("{}: {} Hz", i + 1, number_of(f_Hz, 5))}, {std::move(panel)}));
    }
  }
  return block;
}

CurvesBlock comparison_convergence(const std::vector<NamedArm>& arms) {
  CurvesBlock block{{"convergence", "Error over degrees of freedom",
                     "Relative error of poles and zeros with respect to the exact transfer "
                     "function, down to the rounding floor."},
                    {"degrees of freedom", "", AxisScale::logarithmic},
                    choices_of(arms, {"roots", "refined"}),
                    {}};
  for (const NamedArm& arm : arms) {
    std::vector<std::pair<compare::FeatureFamily, std::string>> seen;
    const auto& refinements = arm.arm->comparison.refinements;
    for (const auto& first : refinements) {
      const std::pair key(first.family, first.refinement);
      if (std::ranges::find(seen, key) != seen.end()) continue;
      seen.push_back(key);
      CurvesPanel panel{{"relative error", "", AxisScale::logarithmic}, 1.0, {}};
      for (const auto& refined : refinements) {
        if (refined.family != first.family || refined.refinement != first.refinement) continue;
        if (!is_drawn(refined)) continue;
        panel.series.push_back(convergence_series(refined, panel.series.size()));
      }
      if (panel.series.empty()) continue;
      block.views.push_back(view_of(
          arm, {family_name(first.family), text_in_words(first.refinement)}, {std::move(panel)}));
    }
  }
  return block;
}

std::vector<MapBlock> comparison_maps(const NamedArm& arm) {
  const Comparison& comparison = arm.arm->comparison;
  std::vector<arm::Sensor> all;
  for (const auto& response : comparison.responses) all.push_back(response.sensor);
  const bool coincide = std::ranges::all_of(comparison.roots, [](const compare::RootRow& row) {
    return std::ranges::all_of(row.distance,
                               [](double distance) { return distance <= kVisibleDistance; });
  });
  std::vector<MapBlock> maps;
  for (const auto& sensors : sensors_by_zeros(all)) {
    MapBlock map = root_map("map-" + arm::to_string(sensors.front()), map_title(sensors),
                            coincide ? kCoincide : "");
    for (const auto& row : arm.arm->measured.rows) {
      const auto& entry = row.measured;
      const bool is_zero = entry.feature == measured::Feature::zero;
      const bool is_other = is_zero && std::ranges::find(sensors, *entry.sensor) == sensors.end();
      if (!entry.frequency_Hz || is_other) continue;
      const std::string order = row.order ? fmt::format(" {}", *row.order) : "";
      add_root(map, {"measured", Role::measured},
               {is_zero ? Mark::zero : Mark::pole, (is_zero ? "zero" : "pole") + order,
                *entry.frequency_Hz, entry.frequency_std_Hz, entry.damping_ratio,
                entry.damping_ratio_std});
    }
    for (std::size_t k = 0; k < (coincide ? 1 : comparison.subjects.size()); ++k) {
      add_formulation(map, comparison, k, sensors.front());
    }
    maps.push_back(std::move(map));
  }
  return maps;
}

}  // namespace flexarm::report::page
