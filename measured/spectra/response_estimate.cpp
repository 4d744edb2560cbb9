#include "measured/spectra/response_estimate.hpp"

#include "arm/input_error.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/spectra/error_correlation.hpp"
#include "measured/spectra/instrument_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

/// Of each line, 1 or what the torque's hold does to it.
std::vector<Complex> hold_at(const std::vector<double>& frequency_Hz, double period_s,
                             const ChosenSettings& settings) {
  std::vector<Complex> hold(frequency_Hz.size(), 1.0);
  if (!settings.hold_corrected) return hold;
  for (std::size_t k = 0; k < hold.size(); ++k) {
    hold[k] = hold_response(settings.hold, frequency_Hz[k], period_s);
  }
  return hold;
}

void take_off_hold(const std::vector<Complex>& hold, FrequencyResponseEstimators& estimators) {
  for (std::size_t k = 0; k < hold.size(); ++k) {
    estimators.h1[k] /= hold[k];
    estimators.h2[k] /= hold[k];
    estimators.hv[k] /= hold[k];
  }
}

void from_segments(const TimeRecord& record, FrequencyResponseEstimate& made) {
  const double period_s = sampling_period_s(record);
  const Estimator& estimator = made.settings.estimator;
  const Signal input = signal_of(record, estimator.input);
  const auto outputs = output_signals(record, made.settings);
  auto spectra = cross_spectra(input, outputs, period_s, made.settings.plan);
  std::vector<Signal> all = outputs;
  all.insert(all.begin(), input);
  if (estimator.instrument || estimator.hub_held()) {
    made.joint = joint_spectra(all, period_s, made.settings.plan);
  }
  CrossSpectra of_instrument;
  if (estimator.instrument) {
    of_instrument =
        cross_spectra(signal_of(record, *estimator.instrument), all, period_s, made.settings.plan);
    made.input_relative_std = instrument_relative_std(of_instrument);
  }
  made.averages = spectra.effective_averages;
  made.spacing_Hz = spectra.spacing_Hz;
  made.noise_bandwidth_Hz = spectra.noise_bandwidth_Hz;
  made.sampling_period_s = period_s;
  made.hold = hold_at(spectra.frequency_Hz, period_s, made.settings);
  const std::size_t lines = spectra.frequency_Hz.size();
  const bool has_middle = made.settings.plan.segment_samples % 2 == 0;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    ChannelEstimate channel;
    channel.sensor = record.channels[made.settings.outputs[i]].sensor;
    channel.estimators = estimate(spectra, i);
    take_off_hold(made.hold, channel.estimators);
    if (estimator.instrument) {
      channel.ratio = instrument_ratio(spectra, of_instrument, i);
      for (std::size_t k = 0; k < lines; ++k) {
        channel.response.push_back(channel.ratio.y[k] / (channel.ratio.x[k] * made.hold[k]));
      }
    } else {
      channel.response = estimator.hub_held() ? channel.estimators.hv : channel.estimators.h1;
    }
    for (std::size_t k = 0; k < lines; ++k) {
      const bool is_real = k == 0 || (has_middle && k + 1 == lines);
      channel.autopower_relative_std.push_back(relative_autopower_std(made.averages, is_real));
      const double size = std::numbers::sqrt2 * std::abs(channel.response[k]);
      channel.relative_std.push_back(
          estimator.instrument
              ? channel.ratio.deviation(k) / (std::abs(made.hold[k]) * size)
              : relative_response_std(channel.estimators.coherence[k], made.averages));
      channel.response_std.push_back(channel.relative_std[k] * size);
    }
    channel.autopower = std::move(spectra.outputs[i]);
    made.channels.push_back(std::move(channel));
  }
  made.frequency_Hz = std::move(spectra.frequency_Hz);
  made.input_autopower = std::move(spectra.input);
}

/// Spectra of a period's power on the lines, noise of one period included: a sine of amplitude A
/// has A^2/2 on its line.
CrossSpectra period_power(const PeriodicSpectra& all, const std::vector<std::size_t>& lines,
                          double spacing_Hz) {
  CrossSpectra made;
  const double density = 0.5 / spacing_Hz;
  const auto periods = static_cast<double>(all.periods);
  const auto noise = [&](double deviation) {
    return all.periods > 1 ? periods * deviation * deviation : 0.0;
  };
  const auto power = [&](const PeriodicSignal& signal) {
    std::vector<double> found;
    for (const std::size_t k : lines) {
      found.push_back(density * (std::norm(signal.amplitude[k]) + noise(signal.noise_std[k])));
    }
    return found;
  };
  made.input = power(all.input);
  for (std::size_t i = 0; i < all.outputs.size(); ++i) {
    made.outputs.push_back(power(all.outputs[i]));
    auto& cross = made.cross.emplace_back();
    for (const std::size_t k : lines) {
      const Complex both = std::conj(all.input.amplitude[k]) * all.outputs[i].amplitude[k];
      cross.push_back(density *
                      (both + (all.periods > 1 ? periods * all.noise_covariance[k](
                                                               0, 1 + static_cast<Eigen::Index>(i))
                                               : Complex{})));
    }
  }
  return made;
}

void from_periods(const TimeRecord& record, FrequencyResponseEstimate& made) {
  const double period_s = sampling_period_s(record);
  const auto& settings = made.settings;
  const auto outputs = output_signals(record, settings);
  const std::size_t periods = settings.period.periods - settings.left_out_periods;
  const auto all = periodic_spectra(signal_of(record, settings.estimator.input), outputs, period_s,
                                    settings.period.samples, periods);
  made.averages = 1.0 + all.degrees_of_freedom;
  made.spacing_Hz = made.noise_bandwidth_Hz =
      1.0 / (static_cast<double>(settings.period.samples) * period_s);
  // A motion falls with frequency: what is driven shows in what drives it.
  const auto driven =
      settings.estimator.instrument
          ? driven_lines(periodic_spectra(signal_of(record, *settings.estimator.instrument), {},
                                          period_s, settings.period.samples, periods))
          : driven_lines(all);
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < driven.size(); ++k) {
    if (!driven[k]) continue;
    lines.push_back(k);
    made.frequency_Hz.push_back(all.frequency_Hz[k]);
    made.input_relative_std.push_back(all.input.noise_std[k] / std::abs(all.input.amplitude[k]));
    if (all.periods > 1) made.joint.push_back(all.noise_covariance[k]);
  }
  auto spectra = period_power(all, lines, made.spacing_Hz);
  made.sampling_period_s = period_s;
  made.hold = hold_at(made.frequency_Hz, period_s, settings);
  const auto& x = all.input;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    ChannelEstimate channel;
    channel.sensor = record.channels[settings.outputs[i]].sensor;
    channel.estimators = estimate(spectra, i);
    take_off_hold(made.hold, channel.estimators);
    const auto& y = all.outputs[i];
    for (std::size_t j = 0; j < lines.size(); ++j) {
      const std::size_t k = lines[j];
      channel.ratio.x.push_back(x.amplitude[k]);
      channel.ratio.y.push_back(y.amplitude[k]);
      channel.ratio.x_variance.push_back(x.noise_std[k] * x.noise_std[k]);
      channel.ratio.y_variance.push_back(y.noise_std[k] * y.noise_std[k]);
      channel.ratio.covariance.push_back(
          all.periods > 1 ? all.noise_covariance[k](0, 1 + static_cast<Eigen::Index>(i))
                          : Complex(kUnknown, kUnknown));
      channel.response.push_back(y.amplitude[k] / (x.amplitude[k] * made.hold[j]));
      channel.response_std.push_back(channel.ratio.deviation(j) / std::abs(made.hold[j]));
      if (all.periods == 1) {
        channel.response_std.back() = kUnknown;
        channel.estimators.coherence[j] = kUnknown;
      }
      channel.relative_std.push_back(channel.response_std.back() /
                                     (std::sqrt(2.0) * std::abs(channel.response.back())));
      // |Y + dY|^2 of an amplitude with noise of its own: d/|Y| twice, along Y.
      channel.autopower_relative_std.push_back(std::sqrt(2.0) * y.noise_std[k] /
                                               std::abs(y.amplitude[k]));
    }
    channel.autopower = std::move(spectra.outputs[i]);
    made.channels.push_back(std::move(channel));
  }
  made.input_autopower = std::move(spectra.input);
  made.periodic = all;
}

}  // namespace

FrequencyResponseEstimate estimate_frequency_response(const TimeRecord& record,
                                                      const SpectrumSettings& settings) {
  if (record.channels.empty()) {
    throw arm::InputError("no sensor: a frequency response needs one channel or more");
  }
  FrequencyResponseEstimate made;
  made.settings = choose_settings(record, settings);
  if (made.settings.periodic) {
    from_periods(record, made);
  } else {
    from_segments(record, made);
  }
  return made;
}

bool is_excited(const FrequencyResponseEstimate& estimate, std::size_t line) {
  if (estimate.input_relative_std.empty()) return true;
  const double deviation = estimate.input_relative_std[line];
  const bool one_period = estimate.periodic && estimate.periodic->periods == 1;
  return one_period || deviation <= kMostInputStd;
}

FrequencyRecord to_frequency_record(const FrequencyResponseEstimate& estimate) {
  FrequencyRecord record;
  const Estimator& estimator = estimate.settings.estimator;
  record.input = estimator.hub_sensor();
  const bool has_instrument = estimator.instrument.has_value();
  for (const auto& channel : estimate.channels) {
    FrequencyChannel made{channel.sensor, {}, {}, {}};
    for (std::size_t k = 0; k < estimate.frequency_Hz.size(); ++k) {
      const Complex value = channel.response[k];
      if (estimate.frequency_Hz[k] == 0.0 || !std::isfinite(std::abs(value))) continue;
      if (has_instrument && !is_excited(estimate, k)) continue;
      made.frequency_Hz.push_back(estimate.frequency_Hz[k]);
      made.response.push_back(value);
      const double spread = channel.relative_std[k];
      made.coherence.push_back(has_instrument
                                   ? 1.0 / (1.0 + 2.0 * (estimate.averages - 1.0) * spread * spread)
                                   : channel.estimators.coherence[k]);
    }
    if (!made.response.empty()) record.channels.push_back(std::move(made));
  }
  return record;
}

}  // namespace flexarm::measured
