#pragma once

#include "response/arm_parts.hpp"

#include <complex>
#include <vector>

namespace flexarm::response {

/// What is linear between the commanded torque and the hub, and between a sensor and its reading.
/// The defaults change nothing.
struct LinearChain {
  double gain = 1.0;
  double delay_s = 0.0;
  double lag_s = 0.0;
  std::vector<SensorChain> sensor_chains = {};  ///< one a sensor at most, without offsets

  bool operator==(const LinearChain&) const = default;
};

/// The linear part of the arm's actuator and sensor effects. Left out are those that
/// `nonlinear_effects` names, and a bias or a sensor's offset, which move the working point only.
LinearChain linear_chain(const ArmParts& parts);

/// T/tau = gain exp(-delay s)/(1 + lag s), the torque on the hub per commanded torque.
std::complex<double> actuator_response(const LinearChain& chain, std::complex<double> s_rad_per_s);

/// Reading per value of that sensor, gain exp(-delay s)/(1 + lag s).
std::complex<double> reading_response(const LinearChain& chain, const arm::Sensor& sensor,
                                      std::complex<double> s_rad_per_s);

}  // namespace flexarm::response
