#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

/// Nothing is measured on the beam.
Dirt hub_sensors_only() {
  return {.name = "hub_sensors_only",
          .changes_sensors = true,
          .recording = [](double size, Random& /*random*/, Recording& made) {
            if (size == 0.0) return;
            std::erase_if(made.record.channels, [](const measured::Channel& channel) {
              return channel.sensor.kind != arm::SensorKind::hub_angle &&
                     channel.sensor.kind != arm::SensorKind::hub_velocity;
            });
          }};
}

}  // namespace flexarm::trials
