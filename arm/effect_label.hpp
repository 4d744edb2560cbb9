#pragma once

#include <string>

namespace flexarm::arm {

/// Returns an effect as texts name it: "coulomb_friction"; of one on a sensor "sensor_delay on
/// hub_angle". `sensor` is empty otherwise.
inline std::string effect_label(const std::string& effect, const std::string& sensor) {
  return sensor.empty() ? effect : effect + " on " + sensor;
}

}  // namespace flexarm::arm
