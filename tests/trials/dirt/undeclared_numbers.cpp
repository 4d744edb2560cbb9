#include "tests/trials/dirt.hpp"
#include "tests/trials/rough_numbers.hpp"

namespace flexarm::trials {

/// Rigidity, density and hub inertia of the arm file are 3 to 10 % off, and it does not say so.
Dirt undeclared_numbers() {
  return {.name = "undeclared_numbers",
          .named_as = {"flexural_rigidity", "linear_density", "hub_inertia"},
          .arm_file = [](double size, Random& random, arm::Arm& file) {
            make_rough(file, size, random);
          }};
}

}  // namespace flexarm::trials
