#include "response/frequency/continuous_phase.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;

constexpr double kTurn_deg = 360.0;

double degrees(double angle_rad) {
  return angle_rad * kTurn_deg / (2.0 * std::numbers::pi);
}

/// arg, with +180 deg for a negative number whatever the sign of its zero imaginary part.
double angle_deg(Complex value) {
  return degrees(std::arg(Complex(value.real(), value.imag() == 0.0 ? 0.0 : value.imag())));
}

}  // namespace

double PhaseReference::phase_deg(double frequency_Hz) const {
  const double omega = 2.0 * std::numbers::pi * frequency_Hz;
  const Complex u = -omega * omega / Complex(1.0, kelvin_voigt_s * omega);
  double phase = initial_deg - kTurn_deg * frequency_Hz * delay_s;
  for (const double lag_s : lags_s) phase -= degrees(std::atan(omega * lag_s));
  for (const double pole : omega_rad_per_s) phase -= angle_deg(1.0 + u / (pole * pole));
  for (const Complex zero : zeros_rad_per_s) {
    phase += angle_deg(1.0 - u / (zero * zero));
    const bool is_of_quadruple = zero.real() != 0.0 && zero.imag() != 0.0;
    if (is_of_quadruple) phase += angle_deg(1.0 - u / std::conj(zero * zero));
  }
  return phase;
}

PhaseReference phase_reference(const ProductFactors& product, const LinearChain& chain,
                               double kelvin_voigt_s) {
  const SensorChain sensor = chain_of(chain.sensor_chains, product.sensor);
  PhaseReference reference;
  const bool is_negative = product.gain * chain.gain * sensor.gain < 0.0;
  reference.initial_deg = 90.0 * product.power - (is_negative ? 180.0 : 0.0);
  reference.omega_rad_per_s = product.omega_rad_per_s;
  const double lowest_squared = product.lowest_omega_squared_rad2_per_s2;
  if (!product.turns_freely && lowest_squared > 0.0) {
    reference.omega_rad_per_s.push_back(std::sqrt(lowest_squared));
  }
  reference.zeros_rad_per_s = product.zeros_rad_per_s;
  reference.kelvin_voigt_s = kelvin_voigt_s;
  reference.delay_s = chain.delay_s + sensor.delay_s;
  for (const double lag_s : {chain.lag_s, sensor.lag_s}) {
    if (lag_s > 0.0) reference.lags_s.push_back(lag_s);
  }
  return reference;
}

std::vector<double> continuous_phase_deg(const PhaseReference& reference,
                                         std::span<const double> frequency_Hz,
                                         std::span<const Complex> values) {
  std::vector<double> phases;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool has_phase = values[i] != 0.0 && std::isfinite(std::abs(values[i]));
    if (!has_phase) {
      phases.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const double angle = angle_deg(values[i]);
    const double turns = std::round((reference.phase_deg(frequency_Hz[i]) - angle) / kTurn_deg);
    phases.push_back(angle + kTurn_deg * turns);
  }
  return phases;
}

}  // namespace flexarm::response
