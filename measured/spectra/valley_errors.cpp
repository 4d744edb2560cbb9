#include "measured/spectra/valley_errors.hpp"

#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

/// Images to either side; farther ones are small, or damped away.
constexpr int kImages = 3;
/// |G| over its lowest value at which the slope beside a valley is taken.
constexpr double kFlank = 2.0;

/// Power of the frequency that |G| falls with above the modes that are seen.
double fall_of(const arm::Sensor& sensor) {
  if (sensor.kind == arm::SensorKind::strain) return -1.5;
  return arm::derivative_order(sensor) - 2.0;
}

}  // namespace

ValleyErrors::ValleyErrors(std::span<const double> frequency_Hz, std::span<const double> power,
                           std::span<const double> relative_std, double to_Hz,
                           const SampledResponse& sampled)
    : sampled_(sampled) {
  for (std::size_t k = 0; k < frequency_Hz.size(); ++k) {
    if (!(power[k] > 0.0) || !std::isfinite(power[k])) continue;
    frequency_Hz_.push_back(frequency_Hz[k]);
    amplitude_.push_back(std::sqrt(power[k]));
    amplitude_std_.push_back(0.5 * relative_std[k] * amplitude_.back());
  }
  if (frequency_Hz_.empty()) return;
  const double end_Hz = std::min(to_Hz, frequency_Hz_.back());
  std::vector<double> levels;
  for (std::size_t k = 0; k < frequency_Hz_.size(); ++k) {
    if (frequency_Hz_[k] < 0.5 * end_Hz || frequency_Hz_[k] > end_Hz) continue;
    levels.push_back(amplitude_[k] / std::pow(frequency_Hz_[k], fall_of(sampled.sensor)));
  }
  level_ = median(std::move(levels));
}

double ValleyErrors::standard_deviation_Hz(double line_Hz) const {
  const auto lowest = static_cast<std::size_t>(std::ranges::lower_bound(frequency_Hz_, line_Hz) -
                                               frequency_Hz_.begin());
  if (lowest == 0 || lowest + 1 >= frequency_Hz_.size()) return 0.0;
  // Anywhere in the filled part alike.
  return std::hypot(filled_width_Hz(lowest) / std::sqrt(12.0),
                    image_at(line_Hz) / slope_at(lowest));
}

double ValleyErrors::image_at(double frequency_Hz) const {
  if (!(sampled_.period_s > 0.0)) return 0.0;
  const double hold_power = sampled_.hold == TorqueHold::zero ? 1.0 : 2.0;
  double sum = 0.0;
  for (int m = -kImages; m <= kImages; ++m) {
    if (m == 0) continue;
    const double there_Hz = std::abs(frequency_Hz + m / sampled_.period_s);
    sum += std::pow(frequency_Hz / there_Hz, hold_power) *
           std::pow(there_Hz, fall_of(sampled_.sensor));
  }
  return level_ * sum;
}

double ValleyErrors::slope_at(std::size_t lowest) const {
  const double flank = kFlank * amplitude_[lowest];
  std::size_t below = lowest - 1;
  std::size_t above = lowest + 1;
  while (below > 0 && amplitude_[below] < flank) --below;
  while (above + 1 < amplitude_.size() && amplitude_[above] < flank) ++above;
  const double rise = 0.5 * (amplitude_[below] + amplitude_[above]);
  // |G|^2 = lowest^2 + slope^2 (f - f_0)^2: rise sqrt(1 - 1/kFlank^2) is the slope's.
  return rise * std::sqrt(1.0 - 1.0 / (kFlank * kFlank)) /
         (0.5 * (frequency_Hz_[above] - frequency_Hz_[below]));
}

double ValleyErrors::filled_width_Hz(std::size_t lowest) const {
  const auto count = static_cast<std::ptrdiff_t>(amplitude_.size());
  const auto rises = [&](std::ptrdiff_t k) {
    if (k < 0 || k >= count) return true;
    const auto line = static_cast<std::size_t>(k);
    return amplitude_[line] - amplitude_[lowest] >
           kSureRise * std::hypot(amplitude_std_[line], amplitude_std_[lowest]);
  };
  const auto end_of = [&](std::ptrdiff_t step) {
    auto k = static_cast<std::ptrdiff_t>(lowest);
    while (!rises(k + step) || !rises(k + 2 * step)) k += step;
    return frequency_Hz_[static_cast<std::size_t>(k)];
  };
  return end_of(1) - end_of(-1);
}

}  // namespace flexarm::measured
