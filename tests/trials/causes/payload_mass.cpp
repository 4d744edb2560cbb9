#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A mass at the payload's centre.
Cause payload_mass() {
  return {.name = "payload_mass",
          .largest = 2.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"mass", size * natural.beam_kg}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.payload_kg += of.at("mass"); }};
}

}  // namespace flexarm::trials
