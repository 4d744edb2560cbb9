#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A gear that gives way; a size of 1 is as soft as the beam.
Cause drive_compliance() {
  return {.name = "drive_compliance",
          .largest = 2.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            // A loss factor of 0.02 to 0.2 at the first pole of an arm of no hub inertia.
            return {{"stiffness", natural.spring_N_m_per_rad / size},
                    {"rotor_share", between(0.3, 0.8, chance.place)},
                    {"time", between(0.02, 0.2, chance.ratio) / (15.4 * natural.omega_rad_per_s)}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                const double stiffness = of.at("stiffness");
                arm.gear = {of.at("rotor_share"), stiffness, stiffness * of.at("time")};
              }};
}

}  // namespace flexarm::trials
