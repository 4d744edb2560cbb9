#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// m is not what the file says.
Cause linear_density() {
  return {.name = "linear_density",
          .acts_on = ActsOn::number,
          .largest = 0.9,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& chance) -> Parameters {
            return {{"factor", std::exp(chance.sign * size)}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.linear_density_kg_per_m *= of.at("factor"); }};
}

}  // namespace flexarm::trials
