#include "measured/files/decimation.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

/// Stop-band attenuation and pass-band ripple, 1e-4.
constexpr double kAttenuation_dB = 80.0;
/// Edges of the transition in Nyquist frequencies after decimation.
constexpr double kPassEdge = 0.8;
constexpr double kStopEdge = 1.0;

}  // namespace

std::vector<double> decimation_filter(std::size_t factor) {
  const double nyquist = std::numbers::pi / static_cast<double>(factor);  // rad per sample
  const double transition = (kStopEdge - kPassEdge) * nyquist;
  const double cutoff = (kPassEdge + kStopEdge) / 2.0 * nyquist;
  // Kaiser's formulas for order and shape.
  const double order = (kAttenuation_dB - 7.95) / (2.285 * transition);
  const double beta = 0.1102 * (kAttenuation_dB - 8.7);
  const auto half = static_cast<std::size_t>(std::ceil(order / 2.0));
  std::vector<double> filter(2 * half + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < filter.size(); ++k) {
    const double n = static_cast<double>(k) - static_cast<double>(half);
    const double place = n / static_cast<double>(half);
    const double window = std::cyl_bessel_i(0.0, beta * std::sqrt(1.0 - place * place));
    const double sinc = k == half ? cutoff : std::sin(cutoff * n) / n;
    filter[k] = window * sinc;
    sum += filter[k];
  }
  for (double& value : filter) value /= sum;
  return filter;
}

std::size_t fewest_samples(std::size_t factor) {
  return decimation_filter(factor).size() + factor;
}

TimeRecord decimated(const TimeRecord& record, std::size_t factor) {
  const std::vector<double> filter = decimation_filter(factor);
  const std::size_t half = filter.size() / 2;
  const std::size_t samples = record.time_s.size();
  if (samples < fewest_samples(factor)) {
    throw arm::InputError(
        fmt::format("{} samples are too few to decimate by {}, whose filter has {}; needs {} or "
                    "more",
                    samples, factor, filter.size(), fewest_samples(factor)));
  }
  std::vector<std::size_t> kept;
  for (std::size_t k = half; k + half < samples; k += factor) kept.push_back(k);
  const auto filtered = [&](const std::vector<double>& values) {
    std::vector<double> out;
    for (const std::size_t centre : kept) {
      double sum = 0.0;
      for (std::size_t j = 0; j < filter.size(); ++j) sum += filter[j] * values[centre - half + j];
      out.push_back(sum);
    }
    return out;
  };
  TimeRecord result;
  for (const std::size_t k : kept) result.time_s.push_back(record.time_s[k]);
  result.torque_N_m = filtered(record.torque_N_m);
  for (const auto& channel : record.channels) {
    result.channels.push_back({channel.sensor, filtered(channel.values)});
  }
  return result;
}

}  // namespace flexarm::measured
