#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A soft clamp; a size of 1 is as soft as the beam.
Cause root_compliance() {
  return {.name = "root_compliance",
          .largest = 2.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"stiffness", natural.spring_N_m_per_rad / size}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.springs.push_back({0.0, of.at("stiffness")});
              }};
}

}  // namespace flexarm::trials
