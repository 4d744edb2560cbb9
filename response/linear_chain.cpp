#include "response/linear_chain.hpp"

#include <algorithm>

namespace flexarm::response {

LinearChain linear_chain(const ArmParts& parts) {
  return {parts.actuator.gain(), parts.actuator.delay_s, parts.actuator.lag_s, parts.sensor_stages};
}

std::complex<double> actuator_response(const LinearChain& chain, std::complex<double> s_rad_per_s) {
  return chain.gain * std::exp(-s_rad_per_s * chain.delay_s) / (1.0 + chain.lag_s * s_rad_per_s);
}

std::complex<double> reading_response(const LinearChain& chain, const arm::Sensor& sensor,
                                      std::complex<double> s_rad_per_s) {
  const auto stage = std::ranges::find(chain.sensor_stages, sensor, &arm::SensorStage::sensor);
  if (stage == chain.sensor_stages.end()) return 1.0;
  return 1.0 / (1.0 + stage->lag.time_constant_s * s_rad_per_s);
}

}  // namespace flexarm::response
