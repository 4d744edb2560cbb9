#include "measured/spectra/frequency_response.hpp"

#include "measured/files/record_constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

}  // namespace

FrequencyResponseEstimators estimate(const CrossSpectra& spectra, std::size_t output) {
  const auto& s_xx = spectra.input;
  const auto& s_yy = spectra.outputs.at(output);
  const auto& s_xy = spectra.cross.at(output);
  const std::size_t lines = s_xx.size();
  FrequencyResponseEstimators made;
  made.h1.assign(lines, Complex(kUnknown, kUnknown));
  made.h2 = made.h1;
  made.hv = made.h1;
  made.coherence.assign(lines, kUnknown);
  for (std::size_t k = 0; k < lines; ++k) {
    const double size = std::abs(s_xy[k]);
    if (!(s_xx[k] > 0.0 && s_yy[k] > 0.0 && size > 0.0)) continue;
    made.h1[k] = s_xy[k] / s_xx[k];
    made.h2[k] = s_yy[k] / std::conj(s_xy[k]);
    made.hv[k] = std::sqrt(s_yy[k] / s_xx[k]) * (s_xy[k] / size);
    // Roots first: products of small spectra leave the range of a double.
    const double gamma = size / std::sqrt(s_xx[k]) / std::sqrt(s_yy[k]);
    made.coherence[k] = std::min(1.0, gamma * gamma);
  }
  return made;
}

double relative_response_std(double coherence, double averages) {
  if (!(averages > 1.0)) return kUnknown;
  return std::sqrt((1.0 - coherence) / (2.0 * (averages - 1.0) * coherence));
}

double relative_confidence_radius(double coherence, double averages, double probability) {
  if (!(averages > 1.0)) return std::numeric_limits<double>::infinity();
  const double ratio = std::expm1(-std::log1p(-probability) / (averages - 1.0));
  return std::sqrt((1.0 - coherence) / coherence * ratio);
}

double coherence_bias(double coherence, double averages) {
  const double rest = 1.0 - coherence;
  return rest * rest / averages * (1.0 + 2.0 * coherence / averages);
}

double coherence_std(double coherence, double averages) {
  return std::sqrt(2.0 * coherence / averages) * (1.0 - coherence);
}

double coherence_of_chance(double averages, double probability) {
  if (!(averages > 1.0)) return 1.0;
  return -std::expm1(std::log(probability) / (averages - 1.0));
}

std::complex<double> hold_response(TorqueHold hold, double frequency_Hz, double period_s) {
  const double half = std::numbers::pi * frequency_Hz * period_s;
  const double sinc = half == 0.0 ? 1.0 : std::sin(half) / half;
  return hold == TorqueHold::zero ? std::polar(1.0, -half) * sinc : Complex(sinc * sinc);
}

}  // namespace flexarm::measured
