#include "report/figures/diagnosis_figures.hpp"

#include "diagnose/observations.hpp"
#include "measured/spectra/robust.hpp"
#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/hub_law_figure.hpp"
#include "report/figures/meaning.hpp"
#include "report/figures/missing_force_figure.hpp"
#include "report/figures/overlay_figure.hpp"
#include "report/figures/residual_torque.hpp"
#include "report/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <complex>
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

Figure response_overlay(const Experiment& experiment, const Overlay& overlay,
                        const measured::FrequencyChannel& channel, bool has_causes) {
  FrequencyResponsePlot plot;
  const auto& [run, data] = experiment.runs[overlay.run];
  const auto& record = std::get<measured::FrequencyRecord>(data);
  plot.title = fmt::format("{}: {} to {}", run.id, in_words(measured::name_of_input(record)),
                           in_words(overlay.sensor));
  plot.analytical.push_back(
      {kBaselineName, channel.frequency_Hz, diagnose::response_of_parts(overlay.before)});
  if (has_causes) {
    plot.analytical.push_back(
        {kExtendedName, channel.frequency_Hz, diagnose::response_of_parts(overlay.after)});
  }
  return frequency_response_figure(measured_response(channel, {}, record.input), plot);
}

/// Limits of an axis from most samples: the last ones say little of the torque
/// (HubResponse::torque), and spikes would set the scale. The panel says how many lie outside.
void limit_to_most(const std::vector<double>& torque_N_m, Panel& panel) {
  constexpr double kAside = 0.05;  // of the samples, at each end
  const double low = measured::quantile(torque_N_m, kAside);
  const double high = measured::quantile(torque_N_m, 1.0 - kAside);
  const auto [least, most] = std::ranges::minmax_element(torque_N_m);
  const double margin = high - low;
  if (!(margin > 0.0)) return;
  panel.y.minimum = std::max(low - margin, *least - 0.05 * margin);
  panel.y.maximum = std::min(high + margin, *most + 0.05 * margin);
  const auto outside = std::ranges::count_if(torque_N_m, [&](double value) {
    return value < *panel.y.minimum || value > *panel.y.maximum;
  });
  if (outside == 0) return;
  panel.note = fmt::format("{} of {} samples outside", outside, torque_N_m.size());
}

Panel torque_panel(const diagnose::HubTorque& torque, const diagnose::HubTorqueTrace& trace,
                   bool of_velocity) {
  const auto& x = of_velocity ? trace.velocity_rad_per_s : trace.angle_rad;
  Panel panel{.y = {.label = "residual hub torque", .unit = "N m"}};
  panel.x = of_velocity ? Axis{.label = "hub velocity", .unit = "rad/s"}
                        : Axis{.label = "hub angle", .unit = "rad"};
  limit_to_most(trace.torque_N_m, panel);
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
  Series bars{
      "mean ± 2 standard errors", {}, {}, {.colour = kMeasuredColour, .line_width_px = 1.5}};
  for (std::size_t b = 0; b < bins.x.size(); ++b) {
    for (const double side : {-2.0, 2.0}) {
      bars.x.push_back(bins.x[b]);
      bars.y.push_back(bins.mean[b] + side * bins.std_error[b]);
    }
    bars.x.push_back(bins.x[b]);
    bars.y.push_back(kNotDrawn);
  }
  panel.series.push_back(std::move(bars));
  panel.series.push_back({"mean",
                          bins.x,
                          bins.mean,
                          {.colour = kMeasuredColour,
                           .line = Line::none,
                           .marker = Marker::disc,
                           .marker_size = 0.5}});
  if (TorqueLine found = identified_torque(torque, of_velocity, x); !found.torque_N_m.empty()) {
    panel.series.push_back({"identified terms",
                            std::move(found.x),
                            std::move(found.torque_N_m),
                            {.colour = kIdentifiedColour, .line_width_px = 2.0}});
  }
  return panel;
}

}  // namespace

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
  DiagnosisPlots made;
  const auto add = [&](std::string name, Figure figure) {
    made.plots.push_back({std::move(name), std::move(figure)});
  };
  const bool has_extended = has_after(diagnosis);
  std::vector<std::string> left_out;
  std::size_t runs_drawn = 0;
  std::size_t responses_drawn = 0;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const auto& [run, data] = experiment.runs[r];
    if (std::holds_alternative<measured::TimeRecord>(data)) {
      auto figure = overlay_figure(experiment, diagnosis, r);
      if (!figure) continue;
      if (runs_drawn++ >= kMostDrawnRuns) {
        left_out.push_back(run.id);
        continue;
      }
      add(fmt::format("overlay-{}", run.id), std::move(*figure));
    } else if (const auto* responses = std::get_if<measured::FrequencyRecord>(&data)) {
      responses_drawn += responses->channels.size();
      if (responses_drawn > kMostDrawnResponses) {
        left_out.push_back(run.id);
        continue;
      }
      for (const auto& channel : responses->channels) {
        const Overlay* overlay = overlay_of(diagnosis, r, channel.sensor);
        if (overlay == nullptr) continue;
        add(fmt::format("frf-{}-{}", run.id, overlay->sensor),
            response_overlay(experiment, *overlay, channel, has_extended));
      }
    }
  }
  const auto& torque = diagnosis.symptoms.hub_torque;
  if (depends_on_motion(torque)) {
    add("hub-torque", hub_torque_figure(torque, clearest(torque)));
  }
  if (const auto& law = diagnosis.empirical_law) {
    add("hub-law", hub_law_figure(*law));
  }
  if (const auto& force = diagnosis.missing_force; force && !force->ports.empty()) {
    add("missing-force", missing_force_figure(*force));
  }
  if (!left_out.empty()) {
    made.left_out = fmt::format("no figures for runs {}: limit on the number of figures reached",
                                fmt::join(left_out, ", "));
  }
  return made;
}

}  // namespace flexarm::report
