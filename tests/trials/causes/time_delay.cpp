#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// Sizes are in seconds.
Cause time_delay() {
  return {.name = "time_delay",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::torque_path,
          .largest = 0.1,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"delay", size}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.torque_delay_s += of.at("delay"); }};
}

}  // namespace flexarm::trials
