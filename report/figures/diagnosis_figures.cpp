#include "report/figures/diagnosis_figures.hpp"

#include "measured/spectra/robust.hpp"
#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/hub_law_figure.hpp"
#include "report/figures/missing_force_figure.hpp"
#include "report/figures/residual_torque.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/figures/svg.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <tbb/parallel_for.h>
#include <utility>
#include <variant>

namespace flexarm::report {

namespace {

using diagnose::Diagnosis;
using diagnose::Experiment;
using diagnose::Overlay;

const Overlay* overlay_of(const Diagnosis& diagnosis, std::size_t run, const arm::Sensor& sensor) {
  const std::string name = arm::to_string(sensor);
  const auto at = std::ranges::find_if(diagnosis.overlays, [&](const Overlay& overlay) {
    return overlay.run == run && overlay.sensor == name;
  });
  return at == diagnosis.overlays.end() ? nullptr : &*at;
}

Style measured_style() {
  return {.colour = black, .tint = 0.6, .line_width_px = 3.0};
}
Style before_style() {
  return {.colour = blue, .line_width_px = 1.1};
}
Style after_style() {
  return {.colour = vermillion, .line_width_px = 1.1};
}

const std::string kBefore = "baseline";
const std::string kAfter = "extended arm";

/// The first sensor of the record that is of one of these kinds, in their order.
const arm::Sensor* first_of(const measured::TimeRecord& record,
                            const std::vector<arm::SensorKind>& kinds) {
  for (const arm::SensorKind kind : kinds) {
    for (const auto& channel : record.channels) {
      if (channel.sensor.kind == kind) return &channel.sensor;
    }
  }
  return nullptr;
}

std::vector<const arm::Sensor*> drawn_sensors(const measured::TimeRecord& record) {
  using enum arm::SensorKind;
  std::vector<const arm::Sensor*> sensors;
  const auto add = [&](const arm::Sensor* sensor) {
    if (sensor != nullptr) sensors.push_back(sensor);
  };
  add(first_of(record, {hub_velocity, hub_angle}));
  add(first_of(record, {tip_acceleration, tip_deflection, tip_displacement, strain}));
  return sensors;
}

/// Where `kDrawnSamples` begin in which the overlays without causes are furthest off.
std::size_t worst_stretch(const std::vector<const Overlay*>& overlays) {
  const std::size_t n = overlays.front()->measured.size();
  if (n <= kDrawnSamples) return 0;
  std::vector<double> squares(n + 1);
  for (const Overlay* overlay : overlays) {
    const double scale = measured::standard_deviation(overlay->measured);
    for (std::size_t k = 0; k < n; ++k) {
      squares[k + 1] += std::pow((overlay->measured[k] - overlay->before[k]) / scale, 2);
    }
  }
  std::partial_sum(squares.begin(), squares.end(), squares.begin());
  std::size_t worst = 0;
  for (std::size_t k = 0; k + kDrawnSamples <= n; ++k) {
    if (squares[k + kDrawnSamples] - squares[k] > squares[worst + kDrawnSamples] - squares[worst]) {
      worst = k;
    }
  }
  return worst;
}

struct Stretch {
  std::size_t from = 0;
  std::size_t to = 0;

  std::vector<double> of(const std::vector<double>& values) const {
    return {values.begin() + static_cast<std::ptrdiff_t>(from),
            values.begin() + static_cast<std::ptrdiff_t>(to)};
  }
};

void add_panels(const Overlay& overlay, const arm::Sensor& sensor, const Stretch& stretch,
                const std::vector<double>& time_s, bool has_causes, PanelStack& stack) {
  const auto measured = stretch.of(overlay.measured);
  const auto before = stretch.of(overlay.before);
  const auto after = stretch.of(overlay.after);
  const auto missed = [&](const std::vector<double>& simulated) {
    std::vector<double> made = measured;
    for (std::size_t k = 0; k < made.size(); ++k) made[k] -= simulated[k];
    return made;
  };
  Panel signal{.y = {.label = sensor_label(sensor), .unit = axis_unit(sensor)}, .height = 1.4};
  signal.series.push_back({"measured", time_s, measured, measured_style()});
  signal.series.push_back({kBefore, time_s, before, before_style()});
  Panel error{.y = {.label = "residual", .unit = axis_unit(sensor)}};
  error.series.push_back({kBefore, time_s, missed(before), before_style()});
  if (has_causes) {
    signal.series.push_back({kAfter, time_s, after, after_style()});
    error.series.push_back({kAfter, time_s, missed(after), after_style()});
  }
  stack.panels.push_back(std::move(signal));
  stack.panels.push_back(std::move(error));
}

/// Real and imaginary parts, frequency by frequency.
std::vector<std::complex<double>> as_response(const std::vector<double>& parts) {
  std::vector<std::complex<double>> response;
  for (std::size_t k = 0; k + 1 < parts.size(); k += 2)
    response.emplace_back(parts[k], parts[k + 1]);
  return response;
}

Figure response_overlay(const Experiment& experiment, const Overlay& overlay,
                        const measured::FrequencyChannel& channel, bool has_causes) {
  FrequencyResponsePlot plot;
  plot.title = fmt::format("{}: torque to {}", experiment.runs[overlay.run].run.id, overlay.sensor);
  plot.analytical.push_back({kBefore, channel.frequency_Hz, as_response(overlay.before)});
  if (has_causes) {
    plot.analytical.push_back({kAfter, channel.frequency_Hz, as_response(overlay.after)});
  }
  return frequency_response_figure(measured_response(channel), plot);
}

Panel torque_panel(const diagnose::HubTorque& torque, const diagnose::HubTorqueTrace& trace,
                   bool of_velocity) {
  const auto& x = of_velocity ? trace.velocity_rad_per_s : trace.angle_rad;
  Panel panel{.y = {.label = "residual hub torque", .unit = "N m"}};
  panel.x = of_velocity ? Axis{.label = "hub velocity", .unit = "rad/s"}
                        : Axis{.label = "hub angle", .unit = "rad"};
  // The last samples say little of the torque (HubResponse::torque), and a few spikes would set the
  // scale.
  constexpr double kShown = 0.01;
  const double low = measured::quantile(trace.torque_N_m, kShown);
  const double high = measured::quantile(trace.torque_N_m, 1.0 - kShown);
  panel.y.minimum = low - 0.15 * (high - low);
  panel.y.maximum = high + 0.15 * (high - low);
  Series samples{"samples",
                 {},
                 {},
                 {.colour = grey,
                  .tint = 0.4,
                  .line = Line::none,
                  .marker = Marker::disc,
                  .marker_size = 0.2}};
  constexpr std::size_t kMostPoints = 1500;
  const std::size_t stride = std::max<std::size_t>(1, x.size() / kMostPoints);
  for (std::size_t k = 0; k < x.size(); k += stride) {
    samples.x.push_back(x[k]);
    samples.y.push_back(trace.torque_N_m[k]);
  }
  panel.series.push_back(std::move(samples));
  const TorqueMeans bins = torque_means(x, trace.torque_N_m);
  Series bars{"mean ± 2 standard errors", {}, {}, {.colour = blue, .line_width_px = 1.5}};
  for (std::size_t b = 0; b < bins.x.size(); ++b) {
    for (const double side : {-2.0, 2.0}) {
      bars.x.push_back(bins.x[b]);
      bars.y.push_back(bins.mean[b] + side * bins.std_error[b]);
    }
    bars.x.push_back(bins.x[b]);
    bars.y.push_back(kNotDrawn);
  }
  panel.series.push_back(std::move(bars));
  panel.series.push_back(
      {"mean",
       bins.x,
       bins.mean,
       {.colour = blue, .line = Line::none, .marker = Marker::disc, .marker_size = 0.5}});
  if (TorqueLine found = identified_torque(torque, of_velocity, x); !found.torque_N_m.empty()) {
    panel.series.push_back({"identified terms",
                            std::move(found.x),
                            std::move(found.torque_N_m),
                            {.colour = vermillion, .line_width_px = 2.0}});
  }
  return panel;
}

}  // namespace

Figure overlay_figure(const Experiment& experiment, const Diagnosis& diagnosis, std::size_t run) {
  const auto& record = std::get<measured::TimeRecord>(experiment.runs[run].data);
  const auto sensors = drawn_sensors(record);
  std::vector<const Overlay*> overlays;
  for (const arm::Sensor* sensor : sensors) {
    overlays.push_back(overlay_of(diagnosis, run, *sensor));
  }
  const std::size_t from = worst_stretch(overlays);
  const Stretch stretch{from, std::min(record.time_s.size(), from + kDrawnSamples)};
  constexpr int kPair_px = 330;
  constexpr int kFurniture_px = 110;
  Figure figure;
  figure.title = experiment.runs[run].run.id;
  figure.width_px = 1000;
  figure.height_px = kFurniture_px + kPair_px * static_cast<int>(sensors.size());
  PanelStack stack{.x = {.label = "time", .unit = "s"}};
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    add_panels(*overlays[i], *sensors[i], stretch, stretch.of(record.time_s),
               !diagnosis.causes.empty(), stack);
  }
  figure.stacks.push_back(std::move(stack));
  return figure;
}

Figure hub_torque_figure(const diagnose::HubTorque& torque, const diagnose::HubTorqueTrace& trace) {
  Figure figure;
  figure.title = fmt::format("{}: residual hub torque", trace.run);
  figure.width_px = 1150;
  figure.height_px = 480;
  for (const bool of_velocity : {true, false}) {
    PanelStack stack;
    stack.panels.push_back(torque_panel(torque, trace, of_velocity));
    figure.stacks.push_back(std::move(stack));
  }
  return figure;
}

DiagnosisPlots diagnosis_plots(const Experiment& experiment, const Diagnosis& diagnosis) {
  std::vector<std::pair<std::string, std::function<Figure()>>> makers;
  const bool has_causes = !diagnosis.causes.empty();
  std::vector<std::string> left_out;
  std::size_t runs_drawn = 0;
  std::size_t responses_drawn = 0;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const auto& [run, data] = experiment.runs[r];
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      if (runs_drawn++ >= kMostDrawnRuns || drawn_sensors(*record).empty()) {
        left_out.push_back(run.id);
        continue;
      }
      makers.emplace_back(fmt::format("overlay-{}.svg", run.id),
                          [&, r] { return overlay_figure(experiment, diagnosis, r); });
    } else if (const auto* responses = std::get_if<measured::FrequencyRecord>(&data)) {
      responses_drawn += responses->channels.size();
      if (responses_drawn > kMostDrawnResponses) {
        left_out.push_back(run.id);
        continue;
      }
      for (const auto& channel : responses->channels) {
        const Overlay* overlay = overlay_of(diagnosis, r, channel.sensor);
        makers.emplace_back(fmt::format("frf-{}-{}.svg", run.id, overlay->sensor), [&, overlay] {
          return response_overlay(experiment, *overlay, channel, has_causes);
        });
      }
    }
  }
  const auto& torque = diagnosis.symptoms.hub_torque;
  if (depends_on_motion(torque)) {
    makers.emplace_back("hub-torque.svg",
                        [&] { return hub_torque_figure(torque, clearest(torque)); });
  }
  if (const auto& law = diagnosis.empirical_law) {
    makers.emplace_back("hub-law.svg", [&] { return hub_law_figure(*law); });
  }
  if (const auto& force = diagnosis.missing_force; force && !force->ports.empty()) {
    makers.emplace_back("missing-force.svg", [&] { return missing_force_figure(*force); });
  }
  DiagnosisPlots made;
  made.plots.resize(makers.size());
  tbb::parallel_for(std::size_t{0}, makers.size(), [&](std::size_t i) {
    made.plots[i] = {makers[i].first, to_svg(makers[i].second())};
  });
  if (!left_out.empty()) {
    made.left_out = fmt::format("no figures for runs {}: limit on the number of figures reached",
                                fmt::join(left_out, ", "));
  }
  return made;
}

}  // namespace flexarm::report
