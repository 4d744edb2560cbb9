#include "measured/spectra/spectral_features.hpp"

#include <cmath>

namespace flexarm::measured {

namespace {

std::vector<double> known(std::vector<double> relative_std) {
  for (double& value : relative_std) {
    if (std::isnan(value)) value = 0.0;
  }
  return relative_std;
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
    made.push_back({channel.sensor,
                    peaks_and_valleys(estimate.frequency_Hz, channel.autopower,
                                      known(channel.autopower_relative_std), of_autopower),
                    peaks_and_valleys(estimate.frequency_Hz, power, known(spread), of_response)});
  }
  return made;
}

}  // namespace flexarm::measured
