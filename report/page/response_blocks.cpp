#include "report/page/response_blocks.hpp"

#include "arm/input_error.hpp"
#include "diagnose/observations.hpp"
#include "measured/spectra/estimator_choice.hpp"
#include "measured/spectra/response_estimate.hpp"
#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/measured_curve.hpp"
#include "report/page/excited_lines.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/page_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <utility>

namespace flexarm::report::page {

namespace {

using Responses = std::vector<std::complex<double>>;

/// Measured beside simulated, on one grid.
struct ResponsePair {
  arm::Sensor sensor;
  MeasuredResponse measured;
  Responses before;
  Responses after;
};

/// A value of each line above 0 Hz, with gaps where nothing is known of the measured response,
/// where the value has no place on a logarithmic axis, and over frequencies that were not measured.
template <class ValueOfLine>
Series line_series(const std::string& label, Role role, const MeasuredResponse& measured,
                   const ValueOfLine& value_of) {
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t k = 0; k < measured.frequency_Hz.size(); ++k) {
    const double f_Hz = measured.frequency_Hz[k];
    if (!(f_Hz > 0.0)) continue;
    if (begins_band(measured.frequency_Hz, k)) {
      x.push_back(f_Hz);
      y.push_back(kGapNumber);
    }
    const double value = value_of(k);
    x.push_back(f_Hz);
    y.push_back(value > 0.0 && is_known(measured.relative_std, k) ? value : kGapNumber);
  }
  return curve(label, role, std::move(x), std::move(y));
}

/// Of the simulated response from the measured one, relative.
Series difference(const std::string& label, Role role, const ResponsePair& pair,
                  const Responses& simulated) {
  return line_series(label, role, pair.measured, [&](std::size_t k) {
    const auto& measured = pair.measured.response[k];
    return std::abs(measured - simulated[k]) / std::abs(measured);
  });
}

/// sqrt(E|d response|^2) of the measured response relative to it: real and imaginary parts
/// together.
Series noise_series(const MeasuredResponse& measured) {
  return line_series("noise", Role::noise, measured,
                     [&](std::size_t k) { return std::sqrt(2.0) * measured.relative_std[k]; });
}

std::vector<CurvesPanel> response_panels(const ResponsePair& pair, bool has_causes) {
  const auto& f_Hz = pair.measured.frequency_Hz;
  std::vector<BodeCurve> curves = {{"measured", Role::measured, f_Hz, pair.measured.response,
                                    pair.measured.relative_std, pair.measured.coherence},
                                   {kBeforeLabel, Role::before, f_Hz, pair.before}};
  if (has_causes) curves.push_back({kAfterLabel, Role::after, f_Hz, pair.after});
  for (BodeCurve& simulated : std::span(curves).subspan(1)) {
    for (std::size_t k = 0; k < f_Hz.size(); ++k) {
      if (!is_known(pair.measured.relative_std, k)) simulated.response[k] = kGapNumber;
    }
  }
  auto panels = bode_panels(response_unit(pair.sensor, pair.measured.input), curves);
  if (panels.empty()) return panels;
  CurvesPanel apart{{"relative difference", "", AxisScale::logarithmic}, 0.9, {}};
  apart.series.push_back(difference("arm file", Role::residual_before, pair, pair.before));
  if (has_causes) {
    apart.series.push_back(difference("extended arm", Role::residual_after, pair, pair.after));
  }
  if (has_number(pair.measured.relative_std)) {
    apart.series.push_back(noise_series(pair.measured));
  }
  std::erase_if(apart.series, [](const Series& series) {
    return !has_number(std::get<std::vector<double>>(std::get<Samples>(series.data).y));
  });
  if (apart.series.empty()) return panels;
  panels.push_back(std::move(apart));
  return panels;
}

ResponsePair given(const DiagnosedChannel& channel) {
  const auto& record = std::get<measured::FrequencyRecord>(channel.run->data);
  const arm::Sensor sensor = arm::parse_sensor(channel.overlay->sensor);
  const auto at = std::ranges::find(record.channels, sensor, &measured::FrequencyChannel::sensor);
  return {sensor, measured_response(*at, {}, record.input),
          diagnose::response_of_parts(channel.overlay->before),
          diagnose::response_of_parts(channel.overlay->after)};
}

/// The settings that an estimate came to, as given ones.
measured::SpectrumSettings settings_of(const measured::ChosenSettings& chosen) {
  measured::SpectrumSettings settings;
  settings.periodic = chosen.periodic;
  settings.hold = chosen.hold;
  settings.correct_hold = chosen.hold_corrected;
  settings.estimator = chosen.estimator;
  if (chosen.periodic) {
    settings.period_samples = chosen.period.samples;
    settings.leave_out_periods = chosen.left_out_periods;
    return settings;
  }
  settings.window = chosen.plan.window;
  settings.segment_samples = chosen.plan.segment_samples;
  settings.overlap = 1.0 - static_cast<double>(chosen.plan.shift_samples) /
                               static_cast<double>(chosen.plan.segment_samples);
  settings.detrend = chosen.plan.detrend;
  return settings;
}

/// The run with these signals of its channels in the place of the measured ones.
measured::TimeRecord with_signals(measured::TimeRecord record,
                                  const std::vector<const DiagnosedChannel*>& channels,
                                  std::vector<double> diagnose::Overlay::*signal) {
  for (const DiagnosedChannel* channel : channels) {
    const arm::Sensor sensor = arm::parse_sensor(channel->overlay->sensor);
    const auto at = std::ranges::find(record.channels, sensor, &measured::Channel::sensor);
    at->values = channel->overlay->*signal;
  }
  return record;
}

/// The responses of one run, estimated; empty where that is refused.
std::vector<ResponsePair> estimated(const std::vector<const DiagnosedChannel*>& channels,
                                    bool has_causes) {
  const auto& [run, data] = *channels.front()->run;
  const auto& record = std::get<measured::TimeRecord>(data);
  std::vector<ResponsePair> pairs;
  try {
    measured::SpectrumSettings settings;
    settings.hold = run.torque_hold;
    const auto measured = measured::estimate_by_evidence(record, settings, {});
    const auto same = settings_of(measured.settings);
    const auto before = measured::estimate_frequency_response(
        with_signals(record, channels, &diagnose::Overlay::before), same);
    const auto after = has_causes
                           ? measured::estimate_frequency_response(
                                 with_signals(record, channels, &diagnose::Overlay::after), same)
                           : before;
    if (measured.settings.estimator.hub_held()) return {};
    const auto lines = excited_lines(record, measured.frequency_Hz);
    for (std::size_t k = 0; k < measured.channels.size(); ++k) {
      pairs.push_back({measured.channels[k].sensor, picked(measured_response(measured, k), lines),
                       picked(before.channels[k].response, lines),
                       picked(after.channels[k].response, lines)});
    }
  } catch (const arm::InputError&) {
    return {};
  }
  return pairs;
}

}  // namespace

CurvesBlock diagnosed_responses(const std::vector<DiagnosedChannel>& frequency_channels,
                                const std::vector<DiagnosedChannel>& time_channels,
                                bool has_causes) {
  CurvesBlock block{
      {"response", "Torque to each sensor", ""}, frequency_axis(), {"run", "sensor"}, {}};
  for (const DiagnosedChannel& channel : frequency_channels) {
    const ResponsePair pair = given(channel);
    auto panels = response_panels(pair, has_causes);
    if (panels.empty()) continue;
    auto facts = channel.facts(has_causes);
    if (pair.measured.input) {
      block.head.title = "Frequency responses of each sensor";
      facts.insert(facts.begin(), {"input", "motion of the hub"});
    }
    block.views.push_back(
        {{channel.run->run.id, channel.sensor}, std::move(facts), std::move(panels)});
  }
  std::vector<const measured::MeasuredRun*> runs;
  for (const DiagnosedChannel& channel : time_channels) {
    if (std::ranges::find(runs, channel.run) == runs.end()) runs.push_back(channel.run);
  }
  for (const measured::MeasuredRun* run : runs) {
    std::vector<const DiagnosedChannel*> own;
    for (const DiagnosedChannel& channel : time_channels) {
      const bool is_sensor = channel.overlay->sensor != diagnose::kTorqueChannel;
      if (channel.run == run && is_sensor) own.push_back(&channel);
    }
    if (own.empty()) continue;
    const auto pairs = estimated(own, has_causes);
    for (const DiagnosedChannel* channel : own) {
      const arm::Sensor sensor = arm::parse_sensor(channel->overlay->sensor);
      const auto pair = std::ranges::find(pairs, sensor, &ResponsePair::sensor);
      if (pair == pairs.end()) continue;
      auto panels = response_panels(*pair, has_causes);
      if (panels.empty()) continue;
      block.views.push_back({{run->run.id, channel->sensor}, {}, std::move(panels)});
    }
  }
  block.head.caption = time_channels.empty()
                           ? "Bands show one standard deviation of the measured response."
                           : "Bands show one standard deviation of the measured response. Those of "
                             "time records are estimates; those of the simulated signals are "
                             "estimated in the same way.";
  return block;
}

}  // namespace flexarm::report::page
