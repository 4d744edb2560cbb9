#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// About the payload's centre of mass.
Cause payload_inertia() {
  return {.name = "payload_inertia",
          .largest = 0.1,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"inertia", size * natural.beam_kg * natural.length_m * natural.length_m}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.payload_inertia_kg_m2 += of.at("inertia"); }};
}

}  // namespace flexarm::trials
