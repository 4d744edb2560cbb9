#include "diagnose/noise_floor.hpp"

#include "measured/spectra/fourier.hpp"
#include "measured/spectra/robust.hpp"
#include "measured/spectra/window.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// Mean power of each of up to `kNoiseBands` bands of a windowed periodogram, in the units of a
/// variance of white noise.
struct BandPowers {
  std::vector<double> power;
  double lines_in_band = 0.0;
};

BandPowers band_powers(std::span<const double> samples) {
  const std::size_t n = samples.size();
  const std::vector<double> window = measured::window_values(measured::Window::hann, n);
  const double mean = measured::mean(samples);
  std::vector<double> weighted(n);
  double squares = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    weighted[k] = (samples[k] - mean) * window[k];
    squares += window[k] * window[k];
  }
  measured::RealTransform transform(n);
  std::vector<std::complex<double>> spectrum(transform.lines());
  transform(weighted, spectrum);
  // Neither the mean, which was taken off, nor the highest line, which is real.
  const std::size_t first = 2;
  const std::size_t lines = spectrum.size() > first + 1 ? spectrum.size() - first - 1 : 0;
  const std::size_t bands = std::clamp<std::size_t>(lines / 8, 1, kNoiseBands);
  BandPowers made;
  made.lines_in_band = static_cast<double>(lines) / static_cast<double>(bands);
  for (std::size_t b = 0; b < bands; ++b) {
    const std::size_t from = first + b * lines / bands;
    const std::size_t to = first + (b + 1) * lines / bands;
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += std::norm(spectrum[k]) / squares;
    if (to > from) made.power.push_back(sum / static_cast<double>(to - from));
  }
  return made;
}

}  // namespace

double white_noise(std::span<const double> samples) {
  constexpr double kSameNoise = 4.0;  // standard deviations of a band's mean
  BandPowers bands = band_powers(samples);
  if (bands.power.empty()) return 0.0;
  std::ranges::sort(bands.power);
  const double spread =
      std::sqrt(measured::shared_line_variance(measured::Window::hann) / bands.lines_in_band);
  double sum = bands.power.front();
  double mean = sum;
  std::size_t taken = 1;
  while (taken < bands.power.size() && bands.power[taken] <= mean * (1.0 + kSameNoise * spread)) {
    sum += bands.power[taken];
    ++taken;
    mean = sum / static_cast<double>(taken);
  }
  return std::sqrt(mean);
}

std::vector<double> relative_scatter(const measured::FrequencyChannel& channel) {
  const std::size_t n = channel.response.size();
  const auto stated = [&channel](std::size_t k) {
    const double coherence = channel.coherence[k];
    return std::isnan(coherence) ? 1.0 : std::sqrt((1.0 - coherence) / (2.0 * coherence));
  };
  // Fourth differences leave a smooth course out; 70 is the sum of their squared weights. The
  // median is that of half a chi-squared variable of two degrees of freedom.
  std::vector<double> ratios;
  for (std::size_t k = 2; k + 2 < n; ++k) {
    const auto& h = channel.response;
    const auto scatter = h[k - 2] - 4.0 * h[k - 1] + 6.0 * h[k] - 4.0 * h[k + 1] + h[k + 2];
    const double size = std::abs(h[k]) * stated(k);
    if (size > 0.0) ratios.push_back(std::norm(scatter) / (70.0 * size * size));
  }
  constexpr double kFewest = 5;
  double scale = 1.0;
  if (static_cast<double>(ratios.size()) >= kFewest) {
    scale = std::sqrt(measured::median(std::move(ratios)) / (2.0 * std::numbers::ln2));
  }
  std::vector<double> made(n);
  for (std::size_t k = 0; k < n; ++k) made[k] = scale * stated(k);
  return made;
}

}  // namespace flexarm::diagnose
