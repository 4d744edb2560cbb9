#include "measured/spectra/spectral_features.hpp"

#include "measured/spectra/valley_errors.hpp"

#include <cmath>

namespace flexarm::measured {

namespace {

/// A valley whose place is known worse than this part of its frequency says nothing of a zero.
constexpr double kMostZeroError = 0.25;

std::vector<double> known(std::vector<double> relative_std) {
  for (double& value : relative_std) {
    if (std::isnan(value)) value = 0.0;
  }
  return relative_std;
}

/// Peaks and valleys of a spectrum, valleys with all that moves them.
std::vector<SpectralFeature> features_of(const std::vector<double>& frequency_Hz,
                                         const std::vector<double>& power,
                                         const std::vector<double>& relative_std,
                                         const PeakSettings& settings,
                                         const SampledResponse& sampled) {
  auto found = peaks_and_valleys(frequency_Hz, power, relative_std, settings);
  const ValleyErrors errors(frequency_Hz, power, relative_std, settings.to_Hz, sampled);
  for (SpectralFeature& feature : found) {
    if (feature.feature != Feature::zero) continue;
    feature.frequency_uncertainty_Hz =
        std::hypot(feature.frequency_uncertainty_Hz, errors.standard_deviation_Hz(feature.line_Hz));
  }
  std::erase_if(found, [](const SpectralFeature& feature) {
    return feature.feature == Feature::zero &&
           feature.frequency_uncertainty_Hz > kMostZeroError * feature.frequency_Hz;
  });
  return found;
}

}  // namespace

std::vector<SensorFeatures> spectral_features(const FrequencyResponseEstimate& estimate,
                                              const PeakSettings& settings) {
  std::vector<SensorFeatures> made;
  PeakSettings of_autopower = settings;
  of_autopower.noise =
      estimate.settings.periodic ? PowerNoise::additive : PowerNoise::multiplicative;
  if (!estimate.settings.periodic) {
    of_autopower.shared_variance = shared_line_variance(estimate.settings.plan.window);
  }
  PeakSettings of_response = of_autopower;
  of_response.noise = PowerNoise::additive;
  for (const auto& channel : estimate.channels) {
    std::vector<double> power;
    std::vector<double> spread;
    for (std::size_t k = 0; k < channel.response.size(); ++k) {
      power.push_back(std::norm(channel.response[k]));
      spread.push_back(2.0 * channel.relative_std[k]);
    }
    const bool is_held = estimate.settings.estimator.hub_held();
    const SampledResponse sampled{channel.sensor, estimate.settings.hold,
                                  is_held ? 0.0 : estimate.sampling_period_s};
    made.push_back(
        {channel.sensor,
         features_of(estimate.frequency_Hz, channel.autopower,
                     known(channel.autopower_relative_std), of_autopower, sampled),
         features_of(estimate.frequency_Hz, power, known(spread), of_response, sampled)});
  }
  return made;
}

}  // namespace flexarm::measured
