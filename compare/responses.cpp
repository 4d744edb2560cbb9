#include "compare/responses.hpp"

#include "response/frequency/frequency_grid.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>

namespace flexarm::compare {

namespace {

bool is_off_resonance(double frequency_Hz, const std::vector<double>& features_Hz) {
  for (const double feature : features_Hz) {
    if (std::abs(frequency_Hz - feature) <= kOffResonance * feature) return false;
  }
  return true;
}

}  // namespace

std::vector<double> response_grid_Hz(const std::vector<double>& pole_frequency_Hz, int points,
                                     const std::vector<double>& features_Hz) {
  std::vector<std::complex<double>> features_rad_per_s;
  for (const double feature_Hz : features_Hz) {
    features_rad_per_s.emplace_back(0.0, 2.0 * std::numbers::pi * feature_Hz);
  }
  return response::refined_frequencies({.from_Hz = 0.1 * pole_frequency_Hz.front(),
                                        .to_Hz = (1.0 - kOffResonance) * pole_frequency_Hz.back(),
                                        .points = points},
                                       features_rad_per_s);
}

ResponseComparison compare_responses(const std::vector<response::AnyFormulation>& formulations,
                                     const arm::Sensor& sensor,
                                     const std::vector<double>& frequency_Hz,
                                     const std::vector<double>& features_Hz) {
  ResponseComparison result;
  result.sensor = sensor;
  result.frequency_Hz = frequency_Hz;
  for (const auto& formulation : formulations) {
    std::vector<std::complex<double>> values;
    for (const double f : frequency_Hz) {
      values.push_back(
          response::transfer_function(formulation, sensor, {0.0, 2.0 * std::numbers::pi * f}));
    }
    std::vector<double> error;
    double largest = 0.0;
    double largest_at_Hz = std::numeric_limits<double>::quiet_NaN();
    const auto& reference = result.values.empty() ? values : result.values.front();
    for (std::size_t k = 0; k < values.size(); ++k) {
      error.push_back(std::abs(values[k] - reference[k]) / std::abs(reference[k]));
      // NaN is worse than any number, and stays.
      if (!std::isnan(largest) && !(error[k] <= largest) &&
          is_off_resonance(frequency_Hz[k], features_Hz)) {
        largest = error[k];
        largest_at_Hz = frequency_Hz[k];
      }
    }
    result.values.push_back(std::move(values));
    result.relative_error.push_back(std::move(error));
    result.largest_error.push_back(largest);
    result.largest_error_frequency_Hz.push_back(largest_at_Hz);
  }
  const auto n = static_cast<double>(formulations.size());
  for (std::size_t k = 0; k < frequency_Hz.size(); ++k) {
    // n sum |G|^2 - |sum G|^2 = n sum |G - mean|^2, which does not cancel.
    std::complex<double> mean = 0.0;
    for (const auto& values : result.values) mean += values[k] / n;
    double spread = 0.0;
    double power = 0.0;
    for (const auto& values : result.values) {
      spread += std::norm(values[k] - mean);
      power += std::norm(values[k]);
    }
    result.one_minus_coherence.push_back(spread / power);
  }
  return result;
}

}  // namespace flexarm::compare
