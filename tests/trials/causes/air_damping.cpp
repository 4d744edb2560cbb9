#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// Force per length in proportion to the beam's velocity.
Cause air_damping() {
  return {.name = "air_damping",
          .largest = 3.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"coefficient",
                     size * natural.beam_kg / natural.length_m * natural.omega_rad_per_s}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.air_damping_N_s_per_m2 += of.at("coefficient"); }};
}

}  // namespace flexarm::trials
