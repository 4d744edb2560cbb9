#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// m is not what the file says.
Cause linear_density() {
  return {.name = "linear_density",
          .acts_on = ActsOn::number,
          .largest = 0.9,
          .parameters = changed_factor,
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            arm.linear_density_kg_per_m *= of.at("factor");
          }};
}

}  // namespace flexarm::trials
