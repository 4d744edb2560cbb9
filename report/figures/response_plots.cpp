#include "report/figures/response_plots.hpp"

#include "report/figures/bode_figure.hpp"
#include "report/figures/nyquist_figure.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/tables/response_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace flexarm::report {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

NamedFigure bode(const std::string& formulation, const response::ResponseStudy& study,
                 std::size_t k) {
  const auto& sensor = study.response.sensors[k];
  BodePlot plot;
  plot.title = "Torque to " + sensor_label(sensor);
  plot.unit = unit_text(response_unit(sensor));
  plot.frequency_Hz = study.response.frequency_Hz;
  plot.curves.push_back(
      {in_words(formulation), study.response.values[k], study.response.phase_deg[k]});
  if (study.state_space_response) {
    plot.curves.push_back({"state space", study.state_space_response->values[k],
                           study.state_space_response->phase_deg[k]});
  }
  plot.poles_Hz.push_back(study.damped_poles.lowest.first_rad_per_s.imag() / kTwoPi);
  for (const auto& pole : study.damped_poles.flexible) {
    plot.poles_Hz.push_back(pole.first_rad_per_s.imag() / kTwoPi);
  }
  for (const auto& zero : study.products[k].zeros_rad_per_s) {
    if (zero.real() == 0.0) plot.zeros_Hz.push_back(zero.imag() / kTwoPi);
  }
  Figure figure = bode_figure(plot);
  figure.height_px = study.state_space_response ? 760 : 640;  // room for the unit of a sensor
  return {fmt::format("bode-{}", arm::to_string(sensor)), std::move(figure)};
}

/// The response at all frequencies it is known at, those around the poles among them.
std::vector<std::complex<double>> values_in_order(const response::ResponseStudy& study,
                                                  std::size_t k) {
  std::vector<std::pair<double, std::complex<double>>> points;
  const auto add = [&](const std::vector<double>& frequency_Hz,
                       const std::vector<std::complex<double>>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      points.emplace_back(frequency_Hz[i], values[i]);
    }
  };
  add(study.response.frequency_Hz, study.response.values[k]);
  for (const auto& resonance : study.resonances[k]) add(resonance.frequency_Hz, resonance.values);
  std::ranges::stable_sort(points, {}, [](const auto& point) { return point.first; });
  const double highest_Hz = study.response.frequency_Hz.back();
  std::vector<std::complex<double>> values;
  for (const auto& [frequency_Hz, value] : points) {
    if (frequency_Hz <= highest_Hz) values.push_back(value);
  }
  return values;
}

NamedFigure nyquist(const response::ResponseStudy& study, std::size_t k,
                    const NyquistMarks& marks) {
  const auto& sensor = study.response.sensors[k];
  NyquistPlot plot;
  plot.marks = marks;
  plot.title = "Torque to " + sensor_label(sensor);
  plot.unit = unit_text(response_unit(sensor));
  plot.response = values_in_order(study, k);
  for (const auto& resonance : study.resonances[k]) {
    const double damping_ratio =
        -resonance.pole_rad_per_s.real() / std::abs(resonance.pole_rad_per_s);
    plot.circles.push_back({fmt::format("pole {}: {:.5g} Hz, ζ = {:.3g}", resonance.order,
                                        resonance.pole_rad_per_s.imag() / kTwoPi, damping_ratio),
                            resonance.values, resonance.at_pole, resonance.below, resonance.above});
  }
  return {fmt::format("nyquist-{}", arm::to_string(sensor)), nyquist_figure(plot)};
}

}  // namespace

std::vector<NamedFigure> response_plots(const std::string& formulation,
                                        const response::ResponseStudy& study,
                                        const NyquistMarks& marks) {
  std::vector<NamedFigure> plots;
  for (std::size_t k = 0; k < study.response.sensors.size(); ++k) {
    const auto& values = study.response.values[k];
    if (std::ranges::all_of(values, [](const auto value) { return value == 0.0; })) continue;
    plots.push_back(bode(formulation, study, k));
    if (!study.resonances[k].empty()) plots.push_back(nyquist(study, k, marks));
  }
  return plots;
}

}  // namespace flexarm::report
