#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A mass clamped to the beam.
Cause attached_mass() {
  return {.name = "attached_mass",
          .largest = 1.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"mass", size * natural.beam_kg},
                    {"position", between(0.3, 0.9, chance.place) * natural.length_m}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.point_masses.push_back({of.at("position"), of.at("mass")});
              }};
}

}  // namespace flexarm::trials
