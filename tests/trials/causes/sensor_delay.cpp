#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A channel that is recorded late. Sizes are in seconds.
Cause sensor_delay() {
  return {.name = "sensor_delay",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::sensor,
          .largest = 0.06,
          .acts_on_drawn_sensor = true,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"delay", size}};
          },
          .change = [](const Parameters& of, const arm::Sensor& sensor,
                       TrueArm& arm) { path_of(arm, sensor).delay_s += of.at("delay"); }};
}

}  // namespace flexarm::trials
