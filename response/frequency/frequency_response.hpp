#pragma once

#include "response/any_formulation.hpp"
#include "response/linear_chain.hpp"

#include <complex>
#include <functional>
#include <span>
#include <vector>

namespace flexarm::response {

/// Readings of sensors per commanded torque, at s = i 2 pi f.
struct FrequencyResponse {
  std::vector<double> frequency_Hz;
  std::vector<arm::Sensor> sensors;
  std::vector<std::vector<std::complex<double>>> values;  ///< per sensor, one a frequency
  /// Continuous phase [deg] of each value (response/frequency/continuous_phase.hpp); empty where it
  /// was not asked for.
  std::vector<std::vector<double>> phase_deg = {};
};

/// Is called after each frequency.
using FrequencyDone = std::function<void()>;

/// `transfer_function` of the formulation with the linear part of the actuator and of the sensors,
/// the same for every formulation. Not finite where a frequency is a pole of an undamped arm.
/// Throws InputError for a sensor that the arm cannot carry, and unless `require_ascending`.
FrequencyResponse frequency_response(const AnyFormulation& formulation, const LinearChain& chain,
                                     std::span<const arm::Sensor> sensors,
                                     std::span<const double> frequency_Hz,
                                     const FrequencyDone& done = {});

/// Of the arm alone: readings per torque on the hub. Throws InputError as frequency_response.
FrequencyResponse arm_response(const AnyFormulation& formulation,
                               std::span<const arm::Sensor> sensors,
                               std::span<const double> frequency_Hz,
                               const FrequencyDone& done = {});
/// Of the arm with that `of_arm`, behind and before a chain.
FrequencyResponse with_chain(FrequencyResponse of_arm, const LinearChain& chain);
/// Returns the responses of the other sensors per reading of the last one. What acts on the hub,
/// and the path of the torque, have no influence where that is a sensor of the hub.
FrequencyResponse per_last_sensor(FrequencyResponse per_torque);

/// s = i 2 pi f.
std::complex<double> on_imaginary_axis(double frequency_Hz);

}  // namespace flexarm::response
