#include "measured/spectra/instrument_response.hpp"

#include "measured/spectra/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

double NoisyRatio::deviation(std::size_t line) const {
  return deviation(line, y[line] / x[line]);
}

double NoisyRatio::deviation(std::size_t line, std::complex<double> g) const {
  // Of e = dy - g dx.
  const double variance = y_variance[line] + std::norm(g) * x_variance[line] -
                          2.0 * (std::conj(g) * covariance[line]).real();
  if (!(variance > 0.0)) return 0.0;
  const std::complex<double> of_x =
      (std::conj(covariance[line]) - std::conj(g) * x_variance[line]) / variance;
  const std::complex<double> likeliest = x[line] - of_x * (y[line] - g * x[line]);
  return std::sqrt(variance) / std::abs(likeliest);
}

NoisyRatio instrument_ratio(const CrossSpectra& of_input, const CrossSpectra& of_instrument,
                            std::size_t output) {
  NoisyRatio made;
  made.x = of_instrument.cross.front();
  made.y = of_instrument.cross.at(output + 1);
  const double freedom = of_instrument.effective_averages - 1.0;
  for (std::size_t k = 0; k < made.x.size(); ++k) {
    const double of_z = of_instrument.input[k];
    const auto noise = [&](double power, const std::complex<double>& cross) {
      return std::max(0.0, power * of_z - std::norm(cross)) / freedom;
    };
    made.x_variance.push_back(noise(of_input.input[k], made.x[k]));
    made.y_variance.push_back(noise(of_input.outputs[output][k], made.y[k]));
    made.covariance.push_back(
        (of_z * of_input.cross[output][k] - std::conj(made.x[k]) * made.y[k]) / freedom);
  }
  return made;
}

std::vector<double> instrument_relative_std(const CrossSpectra& of_instrument) {
  std::vector<double> made;
  for (const double coherence : estimate(of_instrument, 0).coherence) {
    made.push_back(std::numbers::sqrt2 *
                   relative_response_std(coherence, of_instrument.effective_averages));
  }
  return made;
}

}  // namespace flexarm::measured
