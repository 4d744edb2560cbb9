#include "measured/modal/response_fit.hpp"

#include "measured/files/sensor_columns.hpp"
#include "measured/modal/common_noise.hpp"
#include "measured/spectra/error_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::measured {

namespace {

/// Fits with the deviations of the fit before.
constexpr int kReweighings = 2;

/// Of the real and of the imaginary part, each half of the second moment; no less than rounding.
double part_of(double deviation, std::complex<double> value) {
  return std::max(deviation / std::numbers::sqrt2,
                  std::numeric_limits<double>::epsilon() * std::abs(value));
}

/// Time derivatives from the motion of the hub that a sensor shows to its acceleration.
int derivatives_to_acceleration(const arm::Sensor& of_hub) {
  return 2 - arm::derivative_order(of_hub);
}

/// Returns whether a sensor shows more than the bending of the beam: a part of it follows the hub.
bool follows_hub(const FrequencyChannel& channel) {
  return !bends_only(channel.sensor.kind);
}

}  // namespace

bool is_fitted_by_responses(const FrequencyResponseEstimate& estimate) {
  const Estimator& estimator = estimate.settings.estimator;
  if (estimator.instrument || estimator.hub_held()) return true;
  if (!estimate.periodic || estimate.periodic->periods < 2) return false;
  const PeriodicSignal& torque = estimate.periodic->input;
  double signal = 0.0;
  double noise = 0.0;
  for (std::size_t k = 0; k < torque.amplitude.size(); ++k) {
    signal += std::norm(torque.amplitude[k]);
    noise += torque.noise_std[k] * torque.noise_std[k];
  }
  return static_cast<double>(estimate.periodic->periods) * noise > kMostTorqueNoise * signal;
}

ModalFit fit_responses(const FrequencyResponseEstimate& estimate, ModalFitOptions options) {
  const Estimator& estimator = estimate.settings.estimator;
  const std::size_t stride =
      estimate.periodic ? 1
                        : static_cast<std::size_t>(main_lobe_lines(estimate.settings.plan.window));
  FrequencyRecord record;
  record.input = estimator.hub_sensor();
  const auto s_at = [&](std::size_t k) {
    return std::complex<double>(0.0, 2.0 * std::numbers::pi * estimate.frequency_Hz[k]);
  };
  // From an estimated response to the one that is fitted, and from the ratio of the signals.
  const auto per_input = [&](std::size_t k) {
    return record.input ? std::pow(s_at(k), -derivatives_to_acceleration(*record.input))
                        : std::complex<double>(1.0);
  };
  const auto per_ratio = [&](std::size_t k) { return per_input(k) / estimate.hold[k]; };
  std::vector<std::vector<std::size_t>> lines;
  options.response_std.clear();
  for (const ChannelEstimate& channel : estimate.channels) {
    FrequencyChannel made{channel.sensor, {}, {}, {}};
    auto& deviation = options.response_std.emplace_back();
    auto& own = lines.emplace_back();
    for (std::size_t k = 0; k < estimate.frequency_Hz.size(); k += stride) {
      const std::complex<double> value = channel.response[k];
      const double part = part_of(channel.response_std[k], value);
      const bool is_known = std::isfinite(std::abs(value)) && std::isfinite(part);
      if (estimate.frequency_Hz[k] == 0.0 || !is_known || !is_excited(estimate, k)) continue;
      const auto factor = per_input(k);
      made.frequency_Hz.push_back(estimate.frequency_Hz[k]);
      made.response.push_back(value * factor);
      made.coherence.push_back(channel.estimators.coherence[k]);
      deviation.push_back(std::abs(factor) * part);
      own.push_back(k);
    }
    record.channels.push_back(std::move(made));
  }
  if (record.input) options.rigid_body = std::ranges::any_of(record.channels, follows_hub);
  // Batches of lines do not hold: a pole is determined by the few lines of its resonance.
  options.robust = false;
  const auto with_correlation = [&](const ModalFit& fit) {
    const auto correlation_at = [&](double frequency_Hz) {
      const auto at = std::ranges::lower_bound(estimate.frequency_Hz, frequency_Hz);
      const auto k = static_cast<std::size_t>(at - estimate.frequency_Hz.begin());
      Eigen::VectorXcd ratios(std::ssize(fit.transfers));
      for (std::size_t j = 0; j < fit.transfers.size(); ++j) {
        ratios(static_cast<Eigen::Index>(j)) = fit.transfers[j].value(s_at(k)) / per_ratio(k);
      }
      return error_correlation(estimate.joint[k], ratios);
    };
    return with_common_noise(fit, record, options.response_std, correlation_at);
  };
  const auto reweigh = [&](const ModalFit& fit) {
    for (std::size_t j = 0; j < record.channels.size(); ++j) {
      const ChannelEstimate& channel = estimate.channels[j];
      for (std::size_t i = 0; i < lines[j].size(); ++i) {
        const std::size_t k = lines[j][i];
        const auto fitted = fit.transfers[j].value(s_at(k));
        options.response_std[j][i] =
            std::abs(per_ratio(k)) *
            part_of(channel.ratio.deviation(k, fitted / per_ratio(k)), channel.response[k]);
      }
    }
  };
  const bool has_ratios = std::ranges::any_of(
      estimate.channels, [](const ChannelEstimate& channel) { return !channel.ratio.x.empty(); });
  for (int round = 0; has_ratios && round < kReweighings; ++round) {
    const ModalFit fit = fit_modes(record, options);
    if (fit.cancelled) return fit;
    reweigh(fit);
  }
  options.covariance = with_correlation;
  return fit_modes(record, options);
}

ModalFit fit_responses(const FrequencyRecord& record, ModalFitOptions options) {
  if (!record.input) return fit_modes(record, options);
  const int derivatives = derivatives_to_acceleration(*record.input);
  FrequencyRecord per_acceleration = record;
  for (FrequencyChannel& channel : per_acceleration.channels) {
    if (!channel.frequency_Hz.empty() && channel.frequency_Hz.front() == 0.0) {
      channel.frequency_Hz.erase(channel.frequency_Hz.begin());
      channel.response.erase(channel.response.begin());
      channel.coherence.erase(channel.coherence.begin());
    }
    for (std::size_t k = 0; k < channel.response.size(); ++k) {
      const std::complex<double> s(0.0, 2.0 * std::numbers::pi * channel.frequency_Hz[k]);
      channel.response[k] *= std::pow(s, -derivatives);
    }
  }
  options.rigid_body = std::ranges::any_of(record.channels, follows_hub);
  return fit_modes(per_acceleration, options);
}

}  // namespace flexarm::measured
