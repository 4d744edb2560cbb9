#include "response/linear_chain.hpp"

#include <vector>

namespace flexarm::response {

LinearChain linear_chain(const ArmParts& parts) {
  LinearChain made = {parts.actuator.gain(), parts.actuator.delay_s, parts.actuator.lag_s,
                      parts.sensor_chains};
  for (SensorChain& chain : made.sensor_chains) chain.offset = 0.0;
  std::erase_if(made.sensor_chains,
                [](const SensorChain& chain) { return chain == SensorChain{chain.sensor}; });
  return made;
}

std::complex<double> actuator_response(const LinearChain& chain, std::complex<double> s_rad_per_s) {
  return chain.gain * std::exp(-s_rad_per_s * chain.delay_s) / (1.0 + chain.lag_s * s_rad_per_s);
}

std::complex<double> reading_response(const LinearChain& chain, const arm::Sensor& sensor,
                                      std::complex<double> s_rad_per_s) {
  const SensorChain of_sensor = chain_of(chain.sensor_chains, sensor);
  return of_sensor.gain * std::exp(-s_rad_per_s * of_sensor.delay_s) /
         (1.0 + of_sensor.lag_s * s_rad_per_s);
}

}  // namespace flexarm::response
