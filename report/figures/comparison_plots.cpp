#include "report/figures/comparison_plots.hpp"

#include "report/figures/bode_figure.hpp"
#include "report/figures/convergence_figure.hpp"
#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/mac_figure.hpp"
#include "report/figures/mode_shape_figure.hpp"
#include "report/figures/overlay_style.hpp"
#include "report/figures/pole_zero_figure.hpp"
#include "report/figures/run_overlay_figure.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/tables/response_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <ranges>

namespace flexarm::report {

namespace {

/// Enough roots to show the trend without a thicket of curves.
constexpr std::array kShownOrders = {1, 2, 3, 5, 10};
constexpr std::size_t kShownModes = 6;

std::string file_part(const compare::FeatureFamily& family) {
  return family.zeros_of ? "zeros-" + arm::to_string(*family.zeros_of) : "poles";
}

std::string plural(const compare::FeatureFamily& family) {
  return family.zeros_of ? "zeros of torque to " + sensor_label(*family.zeros_of) : "poles";
}

bool is_shown(int order) {
  return std::ranges::find(kShownOrders, order) != kShownOrders.end();
}

ConvergenceCurve convergence_curve(const compare::RefinementCurve& curve) {
  ConvergenceCurve drawn{in_words(curve.refinement),
                         fmt::format("{} {}", curve.family.zeros_of ? "zero" : "pole", curve.order),
                         {},
                         {}};
  for (const auto& point : curve.points) {
    drawn.degrees_of_freedom.push_back(point.degrees_of_freedom);
    drawn.relative_error.push_back(point.relative_error);
  }
  return drawn;
}

/// Zero and NaN have no place on a logarithmic axis.
bool has_a_point(const compare::RefinementCurve& curve) {
  return std::ranges::any_of(curve.points,
                             [](const auto& point) { return point.relative_error > 0.0; });
}

/// One picture a family of the refinement curves that `choose` takes, where they have a point.
template <class Choose>
void add_convergence(const compare::Comparison& comparison, const std::string& prefix,
                     const std::string& title, Choose choose, std::vector<NamedFigure>& plots) {
  std::vector<compare::FeatureFamily> drawn;
  for (const auto& first : comparison.refinements) {
    if (std::ranges::find(drawn, first.family) != drawn.end()) continue;
    drawn.push_back(first.family);
    ConvergencePlot plot;
    plot.title = fmt::format("{}: {}", title, plural(first.family));
    for (const auto& curve : comparison.refinements) {
      if (curve.family == first.family && is_shown(curve.order) && choose(curve) &&
          has_a_point(curve)) {
        plot.curves.push_back(convergence_curve(curve));
      }
    }
    if (plot.curves.empty()) continue;
    plots.push_back({prefix + "-" + file_part(first.family), convergence_figure(plot)});
  }
}

/// The roots of subject k in a family, those it has.
std::vector<std::complex<double>> roots_of(const compare::Comparison& comparison, std::size_t k,
                                           const std::optional<arm::Sensor>& zeros_of) {
  std::vector<std::complex<double>> roots;
  for (const auto& row : comparison.roots) {
    if (row.family.zeros_of == zeros_of && row.s_rad_per_s[k]) {
      roots.push_back(*row.s_rad_per_s[k]);
    }
  }
  return with_mirror_images(roots);
}

/// A measured root and its conjugate; one without a damping ratio on the imaginary axis.
void add_measured_root(const measured::ModalEntry& entry,
                       std::vector<std::complex<double>>& roots) {
  if (!entry.frequency_Hz) return;
  const double omega_rad_per_s = 2.0 * std::numbers::pi * *entry.frequency_Hz;
  const double damping_ratio = entry.damping_ratio.value_or(0.0);
  const std::complex<double> s(
      -damping_ratio * omega_rad_per_s,
      omega_rad_per_s * std::sqrt(std::fmax(0.0, 1.0 - damping_ratio * damping_ratio)));
  roots.push_back(s);
  if (s.imag() != 0.0) roots.push_back(std::conj(s));
}

/// What was measured of the transfer function to a sensor. A pole is the same in all.
PoleZeroSet measured_set(const std::vector<compare::MeasuredRow>& rows, const arm::Sensor& sensor) {
  PoleZeroSet set{"measured", {}, {}, true};
  for (const auto& row : rows) {
    const auto& entry = row.measured;
    if (entry.feature == measured::Feature::pole) {
      add_measured_root(entry, set.poles_rad_per_s);
    } else if (entry.sensor == sensor) {
      add_measured_root(entry, set.zeros_rad_per_s);
    }
  }
  return set;
}

/// Of the response of the i-th sensor, with the arm's damping.
NamedFigure pole_zero_map(const compare::Comparison& comparison, std::size_t i,
                          const std::vector<compare::MeasuredRow>& rows) {
  const arm::Sensor& sensor = comparison.responses[i].sensor;
  PoleZeroPlot plot;
  plot.title = "Poles and zeros of torque to " + sensor_label(sensor);
  for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
    if (!comparison.damped.empty()) {
      const compare::DampedRoots& damped = comparison.damped[k];
      plot.sets.push_back(
          {in_words(comparison.subjects[k]), damped.poles_rad_per_s, damped.zeros_rad_per_s[i]});
      continue;
    }
    plot.sets.push_back({in_words(comparison.subjects[k]), roots_of(comparison, k, std::nullopt),
                         roots_of(comparison, k, sensor)});
  }
  if (auto set = measured_set(rows, sensor);
      !set.poles_rad_per_s.empty() || !set.zeros_rad_per_s.empty()) {
    plot.sets.push_back(std::move(set));
  }
  return {"pole-zero-" + arm::to_string(sensor), pole_zero_figure(plot)};
}

NamedFigure bode_diagram(const compare::Comparison& comparison,
                         const compare::ResponseComparison& response) {
  BodePlot plot;
  plot.title = "Torque to " + sensor_label(response.sensor);
  plot.unit = unit_text(response_unit(response.sensor));
  plot.frequency_Hz = response.frequency_Hz;
  for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
    plot.curves.push_back({in_words(comparison.subjects[k]), response.values[k]});
  }
  plot.one_minus_coherence = response.one_minus_coherence;
  return {"bode-" + arm::to_string(response.sensor), bode_figure(plot)};
}

NamedFigure measured_bode(const compare::MeasuredResponse& compared) {
  const arm::Sensor& sensor = compared.measured.sensor;
  FrequencyResponsePlot plot;
  const std::string input = compared.input ? "From " + sensor_label(*compared.input) : "Torque";
  plot.title = fmt::format("{} to {}, measured", input, sensor_label(sensor));
  if (!compared.run.empty()) plot.title += ": " + compared.run;
  for (std::size_t k = 0; k < compared.models.size(); ++k) {
    const bool has_curve = !compared.curves.empty();
    plot.analytical.push_back(
        {in_words(compared.models[k]),
         has_curve ? compared.curve_frequency_Hz : compared.measured.frequency_Hz,
         has_curve ? compared.curves[k] : compared.values[k], formulation_colour(k)});
  }
  const std::string run = compared.run.empty() ? "" : "-" + compared.run;
  return {
      fmt::format("bode-measured-{}{}", arm::to_string(sensor), run),
      frequency_response_figure(measured_response(compared.measured, {}, compared.input), plot)};
}

bool has_measured_values(const compare::MeasuredResponse& compared) {
  return std::ranges::any_of(compared.measured.response, [](const std::complex<double> value) {
    return std::isfinite(std::abs(value)) && value != 0.0;
  });
}

NamedFigure mode_shapes(const compare::Comparison& comparison) {
  ModeShapePlot plot;
  plot.title = "Mode shapes, modal mass I_T";
  plot.station_m = comparison.stations_m;
  const auto& reference = comparison.modes.front();
  for (std::size_t i = 0; i < std::min(reference.size(), kShownModes); ++i) {
    ModeShape shape;
    shape.label = fmt::format("mode {}, {:.5g} Hz", i + 1,
                              reference[i].omega_rad_per_s / (2.0 * std::numbers::pi));
    for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
      if (i >= comparison.modes[k].size()) continue;
      shape.curves.push_back(
          {in_words(comparison.subjects[k]), comparison.modes[k][i].displacement_m});
    }
    plot.modes.push_back(std::move(shape));
  }
  return {"mode-shapes", mode_shape_figure(plot)};
}

}  // namespace

std::vector<NamedFigure> comparison_plots(const compare::Comparison& comparison,
                                          const compare::MeasuredComparison& measured) {
  std::vector<NamedFigure> plots;
  add_convergence(
      comparison, "convergence", "Convergence of the relative error",
      [](const auto& curve) { return !curve.alternative; }, plots);
  add_convergence(
      comparison, "bases", "Bases of assumed modes",
      [](const auto& curve) { return curve.formulation == "assumed_modes"; }, plots);
  for (std::size_t i = 0; i < comparison.responses.size(); ++i) {
    plots.push_back(pole_zero_map(comparison, i, measured.rows));
    plots.push_back(bode_diagram(comparison, comparison.responses[i]));
  }
  if (!comparison.modes.empty()) plots.push_back(mode_shapes(comparison));
  for (const auto& response : measured.responses) {
    if (has_measured_values(response)) plots.push_back(measured_bode(response));
  }
  for (const auto& run : measured.runs) {
    plots.push_back({"overlay-" + run.run, run_overlay_figure(run)});
  }
  for (std::size_t i = 0; i < measured.shapes.size(); ++i) {
    plots.push_back(
        {i == 0 ? "mac" : fmt::format("mac-{}", i + 1), mac_figure(measured.shapes[i])});
  }
  return plots;
}

}  // namespace flexarm::report
