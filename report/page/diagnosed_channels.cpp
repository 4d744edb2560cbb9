#include "report/page/diagnosed_channels.hpp"

#include "report/figures/sensor_label.hpp"
#include "report/page/page_words.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace flexarm::report::page {

namespace {

std::vector<double> with_gaps(std::vector<double> values, const std::vector<std::size_t>& gaps) {
  for (const std::size_t k : gaps) values[k] = kGapNumber;
  return values;
}

std::string fit_text(double nrmse) {
  return number_of(100.0 * (1.0 - nrmse), 4) + " %";
}

DiagnosedChannel channel_of(const measured::MeasuredRun& run, const diagnose::Overlay& overlay,
                            const diagnose::Gain& error) {
  DiagnosedChannel channel{&run, &overlay, &error, text_in_words(overlay.sensor), ""};
  if (run.run.kind == measured::RunKind::modal) return channel;
  if (overlay.sensor == diagnose::kTorqueChannel) {
    channel.unit = "N m";
    return channel;
  }
  const arm::Sensor sensor = arm::parse_sensor(overlay.sensor);
  channel.sensor = sensor_label(sensor);
  channel.unit = axis_unit(sensor);
  if (const auto* record = std::get_if<measured::TimeRecord>(&run.data)) {
    const auto at = std::ranges::find(record->channels, sensor, &measured::Channel::sensor);
    if (at != record->channels.end()) channel.left_out = at->left_out;
  }
  return channel;
}

}  // namespace

std::vector<double> DiagnosedChannel::measured() const {
  return with_gaps(overlay->measured, left_out);
}

std::vector<double> DiagnosedChannel::residual(const std::vector<double>& simulated) const {
  std::vector<double> made = overlay->measured;
  for (std::size_t k = 0; k < made.size(); ++k) made[k] -= simulated[k];
  return with_gaps(std::move(made), left_out);
}

std::vector<Fact> DiagnosedChannel::facts(bool has_causes) const {
  std::vector<Fact> made = {{"fit, arm file", fit_text(error->before)}};
  if (has_causes) made.push_back({"fit, extended arm", fit_text(error->after)});
  made.push_back({"fit that the noise allows", fit_text(error->noise_floor)});
  return made;
}

std::vector<DiagnosedChannel> diagnosed_channels(const diagnose::Experiment& experiment,
                                                 const diagnose::Diagnosis& diagnosis,
                                                 measured::RunKind kind) {
  std::vector<DiagnosedChannel> channels;
  for (std::size_t i = 0; i < diagnosis.overlays.size(); ++i) {
    const diagnose::Overlay& overlay = diagnosis.overlays[i];
    const measured::MeasuredRun& run = experiment.runs[overlay.run];
    if (run.run.kind != kind) continue;
    channels.push_back(channel_of(run, overlay, diagnosis.channels[i].error));
  }
  std::ranges::stable_sort(channels, std::ranges::greater{}, [](const DiagnosedChannel& channel) {
    return channel.error->before - channel.error->noise_floor;
  });
  return channels;
}

}  // namespace flexarm::report::page
