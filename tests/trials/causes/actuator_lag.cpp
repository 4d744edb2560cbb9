#include "tests/trials/cause.hpp"

#include <algorithm>

namespace flexarm::trials {

/// Sizes are in seconds, and mean at most the natural time of the arm.
Cause actuator_lag() {
  return {.name = "actuator_lag",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::torque_path,
          .largest = 0.1,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"time_constant", std::min(size, 1.0 / natural.omega_rad_per_s)}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.torque_lag_s += of.at("time_constant"); }};
}

}  // namespace flexarm::trials
