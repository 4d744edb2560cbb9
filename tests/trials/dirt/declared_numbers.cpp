#include "tests/trials/dirt.hpp"
#include "tests/trials/rough_numbers.hpp"

namespace flexarm::trials {

/// Rigidity, density and hub inertia of the arm file are known to 3 to 10 %, as it says.
Dirt declared_numbers() {
  return {.name = "declared_numbers",
          .refitted = {"beam_thickness", "flexural_rigidity", "hub_inertia", "linear_density"},
          .arm_file = [](double size, Random& random, arm::Arm& file) {
            file.relative_uncertainties = make_rough(file, size, random);
          }};
}

}  // namespace flexarm::trials
