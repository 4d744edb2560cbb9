#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A wrong calibration.
Cause sensor_gain() {
  return {.name = "sensor_gain",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::sensor,
          .largest = 1.2,
          .acts_on_drawn_sensor = true,
          .parameters = changed_factor,
          .change = [](const Parameters& of, const arm::Sensor& sensor, TrueArm& arm) {
            path_of(arm, sensor).gain *= of.at("factor");
          }};
}

}  // namespace flexarm::trials
