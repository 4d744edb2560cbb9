#include "tests/trials/cause.hpp"

#include <algorithm>

namespace flexarm::trials {

/// Sizes are in seconds, and mean at most the natural time of the arm: what is later belongs to
/// another motion.
Cause time_delay() {
  return {.name = "time_delay",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::torque_path,
          .largest = 0.1,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"delay", std::min(size, 1.0 / natural.omega_rad_per_s)}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.torque_delay_s += of.at("delay"); }};
}

}  // namespace flexarm::trials
