#include "tests/trials/noisy_record.hpp"

#include "tests/trials/dirt.hpp"
#include "tests/trials/excitations.hpp"

#include <cstddef>
#include <utility>

namespace flexarm::trials {

measured::TimeRecord noisy_record(SimulatedRun simulated, std::span<const arm::Sensor> sensors,
                                  double noise, Random& random) {
  measured::TimeRecord record;
  record.torque_N_m = std::move(simulated.torque_N_m);
  for (std::size_t k = 0; k < record.torque_N_m.size(); ++k) {
    record.time_s.push_back(static_cast<double>(k) * kSampleTime_s);
  }
  auto& channels = simulated.channels;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double noise_deviation = noise * deviation(channels[i]);
    for (double& value : channels[i]) value += noise_deviation * random.normal();
    record.channels.push_back({sensors[i], std::move(channels[i])});
  }
  return record;
}

}  // namespace flexarm::trials
