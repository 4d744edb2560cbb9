#include "tests/trials/cause.hpp"

namespace flexarm::trials {

Cause coulomb_friction() {
  return {.name = "coulomb_friction",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .largest = 2.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"torque", size * natural.torque_N_m}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.dry_frictions.push_back(
                    [size_N_m = of.at("torque")](double /*speed*/) { return size_N_m; });
              }};
}

}  // namespace flexarm::trials
