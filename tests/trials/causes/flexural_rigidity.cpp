#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// EI is not what the file says.
Cause flexural_rigidity() {
  return {.name = "flexural_rigidity",
          .acts_on = ActsOn::number,
          .largest = 0.9,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& chance) -> Parameters {
            return {{"factor", std::exp(chance.sign * size)}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.flexural_rigidity_N_m2 *= of.at("factor"); }};
}

}  // namespace flexarm::trials
