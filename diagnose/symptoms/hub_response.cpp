#include "diagnose/symptoms/hub_response.hpp"

#include "diagnose/predictors/predictor.hpp"
#include "measured/spectra/fourier.hpp"
#include "measured/spectra/spectra.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"

#include <boost/math/tools/minima.hpp>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// How long a pulse is followed, in records: what has not died by then is taken to have.
constexpr std::size_t kPulseRecords = 3;

/// exp(-a k): a convolution of signals that fade alike fades so too. What rings on, at the arm's
/// poles and, in what undoes its answer, at its zeros, has faded when a transform of `padded`
/// samples comes round.
std::vector<double> fading(std::size_t samples, std::size_t padded) {
  constexpr double kLeft = 1e-4;
  std::vector<double> weights(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    weights[k] = std::pow(kLeft, static_cast<double>(k) / static_cast<double>(padded));
  }
  return weights;
}

std::shared_ptr<const response::ArmSimulator> linear_simulator(const arm::Arm& arm,
                                                               const arm::Sensor& sensor,
                                                               int flexible_modes,
                                                               measured::TorqueHold hold,
                                                               double period_s) {
  const std::vector<arm::Sensor> sensors = {sensor};
  response::ArmParts parts;  // without what is not linear
  parts.linear = response::take_apart(arm).linear;
  const auto model = response::time_model(response::formulation_of_fit(parts.linear), parts,
                                          flexible_modes, sensors);
  return std::make_shared<const response::ArmSimulator>(
      model, parts, sensors, response::options_of_fit(period_s, simulated_hold(hold)));
}

/// Under a torque that is 0 one sample before the first: what is linear between samples rises from
/// there.
std::vector<double> simulated(const response::ArmSimulator& simulator,
                              std::span<const double> torque_N_m) {
  std::vector<double> longer = {0.0};
  longer.insert(longer.end(), torque_N_m.begin(), torque_N_m.end());
  const Eigen::MatrixXd made = simulator.readings(longer);
  return {made.data() + 1, made.data() + made.size()};
}

/// To a torque of 1 N m at the first of so many samples.
std::vector<double> simulated_pulse(const response::ArmSimulator& simulator, std::size_t samples) {
  std::vector<double> pulse_N_m(samples);
  pulse_N_m.front() = 1.0;
  return simulated(simulator, pulse_N_m);
}

/// For transforms of `padded` real values and back. It keeps the factors of the lengths that its
/// thread used, since they take longer to compute than a transform: some 20 bytes a value.
Eigen::FFT<double>& fourier(std::size_t padded) {
  constexpr std::size_t kMostLengths = 16;
  thread_local std::set<std::size_t> lengths;
  thread_local Eigen::FFT<double> transform(Eigen::FFT<double>::impl_type(),
                                            Eigen::FFT<double>::HalfSpectrum);
  if (lengths.insert(padded).second && lengths.size() > kMostLengths) {
    transform.impl().clear();
    lengths = {padded};
  }
  return transform;
}

/// The spectrum of the values and zeros behind them, `padded` in all: padded/2 + 1 lines.
std::vector<std::complex<double>> transformed(std::span<const double> values, std::size_t padded) {
  std::vector<double> longer(values.begin(), values.end());
  longer.resize(padded);
  std::vector<std::complex<double>> spectrum;
  fourier(padded).fwd(spectrum, longer);
  return spectrum;
}

/// From rest: what is before the first value is 0.
std::vector<double> differenced(std::span<const double> values, int times) {
  std::vector<double> made(values.begin(), values.end());
  for (int i = 0; i < times; ++i) {
    for (std::size_t k = made.size(); k-- > 1;) made[k] -= made[k - 1];
  }
  return made;
}

}  // namespace

HubResponse::HubResponse(const arm::Arm& arm, const arm::Sensor& sensor, int flexible_modes,
                         measured::TorqueHold hold, double period_s, std::size_t samples)
    : HubResponse(linear_simulator(arm, sensor, flexible_modes, hold, period_s), samples,
                  measured::differences_until_steady(sensor)) {}

HubResponse::HubResponse(const std::vector<double>& pulse_response)
    : HubResponse(pulse_response, pulse_response.size(), 0) {}

HubResponse::HubResponse(std::shared_ptr<const response::ArmSimulator> simulator,
                         std::size_t samples, int differences)
    : HubResponse(simulated_pulse(*simulator, kPulseRecords * samples), samples, differences) {
  simulator_ = std::move(simulator);
}

HubResponse::HubResponse(const std::vector<double>& pulse_response, std::size_t samples,
                         int differences)
    : samples_(samples),
      padded_(measured::fast_length((kPulseRecords + 1) * samples)),
      padded_twofold_(measured::fast_length(2 * samples)),
      differences_(differences),
      response_(transformed(std::span(pulse_response).first(samples), padded_twofold_)) {
  std::vector<double> steady = differenced(pulse_response, differences_);
  const std::vector<double> weights = fading(steady.size(), padded_);
  for (std::size_t k = 0; k < steady.size(); ++k) steady[k] *= weights[k];
  steady_response_ = transformed(steady, padded_);
}

std::vector<double> HubResponse::transformed_back(const Spectrum& spectrum,
                                                  std::size_t padded) const {
  std::vector<double> values;
  fourier(padded).inv(values, spectrum, static_cast<Eigen::Index>(padded));
  values.resize(samples_);
  return values;
}

std::vector<double> HubResponse::reading(std::span<const double> torque_N_m) const {
  if (simulator_) return simulated(*simulator_, torque_N_m);
  Spectrum spectrum = transformed(torque_N_m, padded_twofold_);
  for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= response_[k];
  return transformed_back(spectrum, padded_twofold_);
}

std::vector<double> HubResponse::adjoint(std::span<const double> values) const {
  Spectrum spectrum = transformed(values, padded_twofold_);
  for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= std::conj(response_[k]);
  return transformed_back(spectrum, padded_twofold_);
}

std::vector<double> HubResponse::torque(std::span<const double> reading, double noise) const {
  const std::vector<double> weights = fading(samples_, padded_);
  std::vector<double> steady = differenced(reading, differences_);
  double squares = 0.0;
  for (std::size_t k = 0; k < samples_; ++k) {
    steady[k] *= weights[k];
    squares += weights[k] * weights[k];
  }
  Spectrum spectrum = transformed(steady, padded_);
  std::vector<double> noise_power(spectrum.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const double place = static_cast<double>(k) / static_cast<double>(padded_);
    noise_power[k] = noise * noise * squares *
                     std::norm(measured::difference_response(place, 1.0, differences_));
    if (k > 0) largest = std::max(largest, std::norm(steady_response_[k]) / noise_power[k]);
  }
  const auto unlikelihood = [&](double logarithm) {
    const double torque_power = std::exp(logarithm);
    double sum = 0.0;
    for (std::size_t k = 1; k < spectrum.size(); ++k) {
      const double power = std::norm(steady_response_[k]) * torque_power + noise_power[k];
      sum += std::log(power) + std::norm(spectrum[k]) / power;
    }
    return sum;
  };
  const double lowest = -std::log(largest);  // of a torque that shows nowhere
  constexpr double kDecades = 24.0;
  constexpr int kBits = 10;
  std::uintmax_t iterations = 60;
  const double torque_power =
      std::exp(boost::math::tools::brent_find_minima(
                   unlikelihood, lowest, lowest + kDecades * std::log(10.0), kBits, iterations)
                   .first);
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const double power = std::norm(steady_response_[k]) + noise_power[k] / torque_power;
    spectrum[k] = power > 0.0 ? spectrum[k] * std::conj(steady_response_[k]) / power : 0.0;
  }
  std::vector<double> made = transformed_back(spectrum, padded_);
  for (std::size_t k = 0; k < samples_; ++k) made[k] /= weights[k];
  return made;
}

}  // namespace flexarm::diagnose
