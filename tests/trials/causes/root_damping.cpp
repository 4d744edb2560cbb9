#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A clamp of rubber; a size of 1 is as soft as the beam.
Cause root_damping() {
  return {.name = "root_damping",
          .largest = 2.0,
          .in_pairs = false,  // another spring at the root would be in series
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            // A loss factor of 0.1 to 0.5 at the first pole of an arm of no hub inertia.
            return {{"stiffness", natural.spring_N_m_per_rad / size},
                    {"time", between(0.1, 0.5, chance.ratio) / (15.4 * natural.omega_rad_per_s)}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                const double stiffness = of.at("stiffness");
                arm.springs.push_back({0.0, stiffness, stiffness * of.at("time")});
              }};
}

}  // namespace flexarm::trials
