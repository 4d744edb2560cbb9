#include "tests/trials/cause.hpp"

#include <algorithm>

namespace flexarm::trials {

/// Sizes are in seconds, and mean at most the natural time of the arm: what is later belongs to
/// another motion.
Cause sensor_lag() {
  return {.name = "sensor_lag",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::sensor,
          .largest = 0.1,
          .acts_on_drawn_sensor = true,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"time_constant", std::min(size, 1.0 / natural.omega_rad_per_s)}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& sensor, TrueArm& arm) {
                path_of(arm, sensor).time_constant_s += of.at("time_constant");
              }};
}

}  // namespace flexarm::trials
