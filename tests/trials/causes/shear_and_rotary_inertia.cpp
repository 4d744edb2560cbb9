#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A Timoshenko beam. It shows in the arm that is soft in shear.
Cause shear_and_rotary_inertia() {
  return {.name = "shear_and_rotary_inertia",
          .largest = 5.0,
          .smallest_part = 0.1,
          .shows_on_arm = "sandwich link",
          .in_pairs = false,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"shear_coefficient", 1.0 / size}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.shear_coefficient = of.at("shear_coefficient"); }};
}

}  // namespace flexarm::trials
