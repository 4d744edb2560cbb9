#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A crack; a size of 1 is as soft as the beam.
Cause local_stiffness_loss() {
  return {.name = "local_stiffness_loss",
          .largest = 3.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"position", between(0.1, 0.7, chance.place) * natural.length_m},
                    {"stiffness", natural.spring_N_m_per_rad / size}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.springs.push_back({of.at("position"), of.at("stiffness")});
              }};
}

}  // namespace flexarm::trials
