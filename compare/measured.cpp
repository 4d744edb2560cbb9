#include "compare/measured.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::compare {

namespace {

/// Frequencies [Hz] of the first model's poles, or of a sensor's zeros on the imaginary axis.
std::vector<double> model_frequencies_Hz(const Comparison& comparison,
                                         const std::optional<arm::Sensor>& zeros_of) {
  std::vector<double> frequencies;
  for (const auto& row : comparison.roots) {
    const std::complex<double> s = *row.s_rad_per_s.front();
    if (row.family.zeros_of == zeros_of && s.real() == 0.0) {
      frequencies.push_back(s.imag() / (2.0 * std::numbers::pi));
    }
  }
  return frequencies;
}

}  // namespace

std::vector<MeasuredRow> beside_model(const measured::ModalTable& measured,
                                      const Comparison& comparison) {
  std::vector<MeasuredRow> rows;
  for (const auto& feature : measured) {
    const bool is_zero = feature.feature == measured::Feature::zero;
    const auto frequencies =
        model_frequencies_Hz(comparison, is_zero ? feature.sensor : std::nullopt);
    MeasuredRow row{feature, std::nullopt, std::numeric_limits<double>::quiet_NaN()};
    const auto index = static_cast<std::size_t>(feature.order - 1);
    if (index < frequencies.size()) row.model_frequency_Hz = frequencies[index];
    if (row.model_frequency_Hz && feature.frequency_Hz) {
      row.error_percent =
          100.0 * (*feature.frequency_Hz - *row.model_frequency_Hz) / *row.model_frequency_Hz;
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<arm::Sensor> sensors_with_zeros(const measured::ModalTable& measured) {
  std::vector<arm::Sensor> sensors;
  for (const auto& feature : measured) {
    if (feature.feature == measured::Feature::zero &&
        std::ranges::find(sensors, *feature.sensor) == sensors.end()) {
      sensors.push_back(*feature.sensor);
    }
  }
  return sensors;
}

}  // namespace flexarm::compare
