#include "diagnose/symptoms/frequency_bands.hpp"

#include "arm/rigid_hub.hpp"
#include "exact_tf/exact_arm.hpp"
#include "measured/spectra/fourier.hpp"
#include "measured/spectra/window.hpp"
#include "response/arm_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::diagnose {

std::vector<FrequencyBand> frequency_bands(const arm::Arm& arm, double top_Hz) {
  if (!arm::has_beam(arm)) return {{"all frequencies", 0.0, top_Hz}};
  std::vector<double> modes_Hz;
  const exact_tf::ExactArm exact(response::take_apart(arm).linear);
  for (const double omega : exact.poles(kMostBandModes).omega_rad_per_s) {
    const double mode_Hz = omega / (2.0 * std::numbers::pi);
    if (mode_Hz < top_Hz) modes_Hz.push_back(mode_Hz);
  }
  if (modes_Hz.empty()) return {{"all frequencies", 0.0, top_Hz}};
  constexpr double kHalfOctave = std::numbers::sqrt2;
  std::vector<FrequencyBand> bands = {{"below mode 1", 0.0, modes_Hz.front() / kHalfOctave}};
  for (std::size_t k = 0; k < modes_Hz.size(); ++k) {
    const double to_Hz = k + 1 < modes_Hz.size() ? std::sqrt(modes_Hz[k] * modes_Hz[k + 1])
                                                 : std::min(modes_Hz[k] * kHalfOctave, top_Hz);
    bands.push_back({fmt::format("around mode {}", k + 1), bands.back().to_Hz, to_Hz});
  }
  if (bands.back().to_Hz < top_Hz) {
    bands.push_back({fmt::format("above mode {}", modes_Hz.size()), bands.back().to_Hz, top_Hz});
  }
  return bands;
}

std::vector<BandPower> band_powers(std::span<const double> samples, double period_s,
                                   std::span<const FrequencyBand> bands) {
  const std::size_t n = samples.size();
  const std::vector<double> window = measured::window_values(measured::Window::hann, n);
  std::vector<double> weighted(n);
  double squares = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    weighted[k] = samples[k] * window[k];
    squares += window[k] * window[k];
  }
  measured::RealTransform transform(n);
  std::vector<std::complex<double>> spectrum(transform.lines());
  transform(weighted, spectrum);
  std::vector<BandPower> powers(bands.size());
  std::size_t band = 0;
  const double spacing_Hz = 1.0 / (static_cast<double>(n) * period_s);
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const double frequency_Hz = static_cast<double>(k) * spacing_Hz;
    while (band + 1 < bands.size() && frequency_Hz >= bands[band].to_Hz) ++band;
    // One-sided: line k stands for -k too, but for 0 and the highest of an even number of samples.
    const double sides = k == 0 || 2 * k == n ? 1.0 : 2.0;
    powers[band].mean_square += sides * std::norm(spectrum[k]) / (squares * static_cast<double>(n));
    powers[band].lines += 0.5 * sides;
  }
  return powers;
}

}  // namespace flexarm::diagnose
