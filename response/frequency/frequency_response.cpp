#include "response/frequency/frequency_response.hpp"

#include "response/frequency/frequency_grid.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <utility>

namespace flexarm::response {

FrequencyResponse frequency_response(const AnyFormulation& formulation, const LinearChain& chain,
                                     std::span<const arm::Sensor> sensors,
                                     std::span<const double> frequency_Hz,
                                     const FrequencyDone& done) {
  return with_chain(arm_response(formulation, sensors, frequency_Hz, done), chain);
}

FrequencyResponse arm_response(const AnyFormulation& formulation,
                               std::span<const arm::Sensor> sensors,
                               std::span<const double> frequency_Hz, const FrequencyDone& done) {
  for (const auto& sensor : sensors) arm::require_valid(sensor, arm_of(formulation));
  require_ascending(frequency_Hz, "frequency");
  FrequencyResponse response;
  response.frequency_Hz.assign(frequency_Hz.begin(), frequency_Hz.end());
  response.sensors.assign(sensors.begin(), sensors.end());
  response.values.resize(sensors.size());
  for (const double frequency : frequency_Hz) {
    const auto values = transfer_functions(formulation, sensors, on_imaginary_axis(frequency));
    for (std::size_t j = 0; j < sensors.size(); ++j) response.values[j].push_back(values[j]);
    if (done) done();
  }
  return response;
}

FrequencyResponse with_chain(FrequencyResponse of_arm, const LinearChain& chain) {
  for (std::size_t k = 0; k < of_arm.frequency_Hz.size(); ++k) {
    const auto s = on_imaginary_axis(of_arm.frequency_Hz[k]);
    const auto actuator = actuator_response(chain, s);
    for (std::size_t j = 0; j < of_arm.sensors.size(); ++j) {
      auto& value = of_arm.values[j][k];
      value = value * actuator * reading_response(chain, of_arm.sensors[j], s);
    }
  }
  return of_arm;
}

FrequencyResponse per_last_sensor(FrequencyResponse per_torque) {
  const auto last = std::move(per_torque.values.back());
  per_torque.values.pop_back();
  per_torque.sensors.pop_back();
  for (auto& of_sensor : per_torque.values) {
    std::ranges::transform(of_sensor, last, of_sensor.begin(), std::divides());
  }
  return per_torque;
}

std::complex<double> on_imaginary_axis(double frequency_Hz) {
  return {0.0, 2.0 * std::numbers::pi * frequency_Hz};
}

}  // namespace flexarm::response
