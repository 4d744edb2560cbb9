#include "measured/checks/data_check_transform.hpp"

#include "measured/spectra/fourier.hpp"
#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kTaper = 0.1;  // of the duration, at each end
constexpr std::size_t kFloorBands = 16;

struct TaperedWindow {
  std::vector<double> value;
  std::vector<double> first;   ///< [1/s]
  std::vector<double> second;  ///< [1/s^2]
};

/// 1, with tapers 6 u^5 - 15 u^4 + 10 u^3, u from 0 to 1: twice differentiable.
TaperedWindow tapered(std::size_t count, double period_s) {
  TaperedWindow window;
  const double duration_s = static_cast<double>(count - 1) * period_s;
  const double taper_s = kTaper * duration_s;
  for (std::size_t k = 0; k < count; ++k) {
    const double before_s = static_cast<double>(k) * period_s;
    const double after_s = duration_s - before_s;
    const double u = std::min(before_s, after_s) / taper_s;
    if (u >= 1.0) {
      window.value.push_back(1.0);
      window.first.push_back(0.0);
      window.second.push_back(0.0);
      continue;
    }
    const double side = before_s < after_s ? 1.0 : -1.0;
    window.value.push_back(u * u * u * (10.0 + u * (6.0 * u - 15.0)));
    window.first.push_back(side * 30.0 * u * u * (1.0 - u) * (1.0 - u) / taper_s);
    window.second.push_back(60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (taper_s * taper_s));
  }
  return window;
}

std::vector<std::complex<double>> transform_of(RealTransform& transform,
                                               const std::vector<double>& values,
                                               const std::vector<double>& weights) {
  std::vector<double> weighted(transform.samples(), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) weighted[k] = weights[k] * values[k];
  std::vector<std::complex<double>> spectrum(transform.lines());
  transform(weighted, spectrum);
  return spectrum;
}

double floor_power(const std::vector<std::complex<double>>& spectrum, double window_power) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t band = 0; band < kFloorBands; ++band) {
    const std::size_t from = std::max<std::size_t>(1, band * spectrum.size() / kFloorBands);
    const std::size_t to = (band + 1) * spectrum.size() / kFloorBands;
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i) sum += std::norm(spectrum[i]);
    if (to > from) least = std::min(least, sum / static_cast<double>(to - from));
  }
  return least / window_power;
}

}  // namespace

std::size_t Transforms::bin_at(double frequency_Hz) const {
  return std::min(bins() - 1, static_cast<std::size_t>(kTwoPi * frequency_Hz / spacing_rad_per_s));
}

std::complex<double> Transforms::derivative(std::size_t signal, int order, std::size_t bin) const {
  const std::complex<double> i_omega(0.0, omega_rad_per_s(bin));
  const auto& transform = of[signal];
  if (order == 0) return transform.plain[bin];
  if (order == 1) return i_omega * transform.plain[bin] - transform.first[bin];
  return i_omega * (i_omega * transform.plain[bin] - 2.0 * transform.first[bin]) +
         transform.second[bin];
}

double Transforms::noise_power(std::size_t signal, int order, std::size_t bin) const {
  return of[signal].floor_power * window_power * std::pow(omega_rad_per_s(bin), 2 * order);
}

namespace {

/// A sensor's reading at rest: zero; where its first reading is far from it, the mean of the first
/// fiftieth of the record, over which noise and hum average out.
double rest_of(const CheckedSignal& signal) {
  constexpr double kFar = 0.1;  // standard deviations
  constexpr std::size_t kShare = 50;
  if (signal.is_torque() || std::abs(signal.values.front()) <= kFar * signal.deviation) return 0.0;
  return mean(signal.values.first(std::max<std::size_t>(1, signal.values.size() / kShare)));
}

/// The values about their mean, with `before` readings at rest in front.
std::vector<double> extended(const CheckedSignal& signal, std::size_t before) {
  std::vector<double> values(before, rest_of(signal));
  values.insert(values.end(), signal.values.begin(), signal.values.end());
  const double offset = mean(values);
  for (auto& value : values) value -= offset;
  return values;
}

}  // namespace

Transforms transform(std::span<const CheckedSignal> signals, double period_s, bool from_rest) {
  const std::size_t samples = signals.front().values.size();
  const std::size_t before =
      from_rest ? static_cast<std::size_t>(1.5 * kTaper * static_cast<double>(samples)) : 0;
  const std::size_t count = samples + before;
  const TaperedWindow window = tapered(count, period_s);
  RealTransform fourier(std::bit_ceil(count));
  Transforms all;
  all.period_s = period_s;
  all.from_rest = from_rest;
  all.duration_s = static_cast<double>(count) * period_s;
  all.spacing_rad_per_s = kTwoPi / (static_cast<double>(fourier.samples()) * period_s);
  all.bins_per_line = static_cast<double>(fourier.samples()) / static_cast<double>(count);
  for (const double value : window.value) all.window_power += value * value;
  for (const auto& signal : signals) {
    const auto values = extended(signal, before);
    Transform transform;
    transform.plain = transform_of(fourier, values, window.value);
    transform.first = transform_of(fourier, values, window.first);
    transform.second = transform_of(fourier, values, window.second);
    transform.floor_power = floor_power(transform.plain, all.window_power);
    all.of.push_back(std::move(transform));
  }
  return all;
}

}  // namespace flexarm::measured
