#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// EI is not what the file says.
Cause flexural_rigidity() {
  return {.name = "flexural_rigidity",
          .acts_on = ActsOn::number,
          .largest = 0.9,
          .parameters = changed_factor,
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            arm.flexural_rigidity_N_m2 *= of.at("factor");
          }};
}

}  // namespace flexarm::trials
