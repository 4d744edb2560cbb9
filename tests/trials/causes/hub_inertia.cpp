#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// Ih is not what the file says.
Cause hub_inertia() {
  return {.name = "hub_inertia",
          .acts_on = ActsOn::number,
          .largest = 1.1,
          .parameters = changed_factor,
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            arm.hub_inertia_kg_m2 *= of.at("factor");
          }};
}

}  // namespace flexarm::trials
