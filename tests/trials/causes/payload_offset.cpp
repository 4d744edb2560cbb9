#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// The payload's centre of mass lies beyond the tip, or short of it.
Cause payload_offset() {
  return {.name = "payload_offset",
          .largest = 0.2,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"offset", chance.sign * size * natural.length_m}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.payload_offset_m += of.at("offset"); }};
}

}  // namespace flexarm::trials
