#include "response/time/sensor_imperfections.hpp"

#include "arm/input_error.hpp"
#include "arm/range.hpp"

#include <cmath>
#include <numeric>

namespace flexarm::response {

namespace {

double standard_deviation(std::span<const double> signal) {
  if (signal.empty()) return 0.0;
  const auto count = static_cast<double>(signal.size());
  const double mean = std::accumulate(signal.begin(), signal.end(), 0.0) / count;
  double sum = 0.0;
  for (const double value : signal) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / count);
}

}  // namespace

double noise_deviation(std::span<const double> signal, const SensorImperfections& imperfections) {
  const double relative = imperfections.relative_noise == 0.0
                              ? 0.0
                              : imperfections.relative_noise * standard_deviation(signal);
  return std::hypot(relative, imperfections.noise);
}

void impair(std::span<double> signal, const SensorImperfections& imperfections,
            RandomNumbers& random) {
  arm::require_in_range("noise", imperfections.relative_noise, "", arm::kNotNegative);
  arm::require_in_range("noise", imperfections.noise, "", arm::kNotNegative);
  arm::require_in_range("quantisation", imperfections.quantisation, "", arm::kNotNegative);
  if (const double deviation = noise_deviation(signal, imperfections); deviation > 0.0) {
    for (auto& value : signal) value += deviation * random.normal();
  }
  if (const double step = imperfections.quantisation; step > 0.0) {
    for (auto& value : signal) value = step * std::round(value / step);
  }
}

}  // namespace flexarm::response
