#include "arm/ports.hpp"

namespace flexarm::arm {

std::string_view to_string(Port port) {
  switch (port) {
    case Port::arm_number:
      return "arm_number";
    case Port::linear_term:
      return "linear_term";
    case Port::sensor_place:
      return "sensor_place";
    case Port::torque_path:
      return "torque_path";
    case Port::hub_torque:
      return "hub_torque";
    case Port::beam_force:
      return "beam_force";
    case Port::sensor_path:
      return "sensor_path";
  }
  return "";
}

}  // namespace flexarm::arm
