#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// The arm hangs; sizes are those of the earth's.
Cause gravity() {
  return {.name = "gravity",
          .largest = 1.0,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"acceleration", size * 9.81}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.gravity_m_per_s2 += of.at("acceleration"); }};
}

}  // namespace flexarm::trials
