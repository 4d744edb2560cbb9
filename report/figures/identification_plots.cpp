#include "report/figures/identification_plots.hpp"

#include "report/figures/autopower_figure.hpp"
#include "report/figures/distortion_figure.hpp"
#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/nyquist_circle_figure.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/figures/stabilisation_figure.hpp"
#include "report/tables/identification_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace flexarm::report {

namespace {

using measured::Identification;
using measured::RunIdentification;

/// A response with a value anywhere.
bool can_be_drawn(const measured::FrequencyChannel& channel) {
  return std::ranges::any_of(channel.response, [](const std::complex<double>& value) {
    return std::isfinite(std::abs(value)) && value != 0.0;
  });
}

std::vector<double> poles_Hz(const compare::AnalyticalModes& analytical) {
  std::vector<double> poles;
  for (const auto& pole : analytical.poles) poles.push_back(pole.frequency_Hz);
  return poles;
}

Figure response_figure(const Identification& identification, std::size_t index, std::size_t k,
                       const compare::AnalyticalModes& analytical) {
  const RunIdentification& run = identification.runs[index];
  const auto& channel = run.response.channels[k];
  FrequencyResponsePlot plot;
  plot.title = fmt::format("{}: torque to {}", run.run.id, sensor_label(channel.sensor));
  plot.fit = fitted_transfer(identification, index, channel.sensor);
  plot.analytical_poles_Hz = poles_Hz(analytical);
  const auto& model = analytical.response;
  const auto sensor = std::ranges::find(model.sensors, channel.sensor);
  if (sensor != model.sensors.end()) {
    plot.analytical.push_back(
        {"analytical", model.frequency_Hz,
         model.values[static_cast<std::size_t>(sensor - model.sensors.begin())]});
  }
  const auto features =
      std::ranges::find(run.features, channel.sensor, &measured::SensorFeatures::sensor);
  if (features != run.features.end()) plot.features = features->response;
  if (!run.estimate) return frequency_response_figure(measured_response(channel), plot);
  const auto& channels = run.estimate->channels;
  const auto at = std::ranges::find(channels, channel.sensor, &measured::ChannelEstimate::sensor);
  return frequency_response_figure(
      measured_response(*run.estimate, static_cast<std::size_t>(at - channels.begin())), plot);
}

void add_run(const Identification& identification, std::size_t index,
             const compare::AnalyticalModes& analytical, std::vector<NamedFigure>& plots) {
  const RunIdentification& run = identification.runs[index];
  if (run.hub_held()) return;  // the analytical responses are those to the torque
  const auto add = [&](std::string name, Figure figure) {
    plots.push_back({std::move(name), std::move(figure)});
  };
  if (run.estimate) {
    add("autopower-" + run.run.id, autopower_figure(*run.estimate, run.features,
                                                    {.title = run.run.id + ": autopower spectra",
                                                     .analytical_poles_Hz = poles_Hz(analytical)}));
  }
  for (std::size_t k = 0; k < run.response.channels.size(); ++k) {
    if (!can_be_drawn(run.response.channels[k])) continue;
    add(fmt::format("frf-{}-{}", run.run.id, arm::to_string(run.response.channels[k].sensor)),
        response_figure(identification, index, k, analytical));
  }
  for (const auto& [sensor, set] : run.circles) {
    if (set.circles.empty()) continue;
    add(fmt::format("circles-{}-{}", run.run.id, arm::to_string(sensor)),
        nyquist_circle_figure(
            sensor, set.circles,
            fmt::format("{}: torque to {}, velocity form", run.run.id, sensor_label(sensor))));
  }
  if (!run.distortion) return;
  for (std::size_t i = 0; i < run.distortion->channels.size(); ++i) {
    const auto& sensor = run.estimate->channels[i].sensor;
    add(fmt::format("distortion-{}-{}", run.run.id, arm::to_string(sensor)),
        distortion_figure(sensor, run.distortion->channels[i],
                          fmt::format("{}: {}, spectral lines", run.run.id, sensor_label(sensor))));
  }
}

}  // namespace

std::optional<measured::FittedTransfer> fitted_transfer(const Identification& identification,
                                                        std::size_t run,
                                                        const arm::Sensor& sensor) {
  for (const auto& fit : identification.fits) {
    if (!fit.refusal.empty() || std::ranges::find(fit.runs, run) == fit.runs.end()) continue;
    const auto at = std::ranges::find(fit.fit.sensors, sensor, &measured::FittedSensor::sensor);
    if (at == fit.fit.sensors.end()) return std::nullopt;
    return fit.fit.transfers[static_cast<std::size_t>(at - fit.fit.sensors.begin())];
  }
  return std::nullopt;
}

std::vector<NamedFigure> identification_plots(
    const Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions) {
  std::vector<NamedFigure> plots;
  for (std::size_t r = 0; r < identification.runs.size(); ++r) {
    const auto condition = std::ranges::find_if(conditions, [&](const auto& candidate) {
      return std::ranges::find(candidate.runs, r) != candidate.runs.end();
    });
    add_run(identification, r, condition->analytical, plots);
  }
  for (const auto& fit : identification.fits) {
    if (!fit.refusal.empty() || fit.fit.chart.poles.empty()) continue;
    const std::string runs = joined(ids_of(fit, identification));
    StabilisationPlot plot{
        .title = runs + ": stabilisation chart",
        .background = mean_response(identification.runs[fit.runs.front()].response)};
    for (const auto& pole : fit.fit.poles) {
      if (pole.is_mode) plot.fitted_poles_Hz.push_back(pole.frequency_Hz);
    }
    plots.push_back(
        {fmt::format("stabilisation-{}", runs), stabilisation_figure(fit.fit.chart, plot)});
  }
  return plots;
}

}  // namespace flexarm::report
