#include "tests/trials/cause.hpp"

#include <algorithm>

namespace flexarm::trials {

/// A channel that is recorded late. Sizes are in seconds, and mean at most half the natural
/// time of the arm: what is later belongs to another motion.
Cause sensor_delay() {
  return {.name = "sensor_delay",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::sensor,
          .largest = 0.06,
          .acts_on_drawn_sensor = true,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"delay", std::min(size, 0.5 / natural.omega_rad_per_s)}};
          },
          .change = [](const Parameters& of, const arm::Sensor& sensor,
                       TrueArm& arm) { path_of(arm, sensor).delay_s += of.at("delay"); }};
}

}  // namespace flexarm::trials
