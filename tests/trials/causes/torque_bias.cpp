#include "tests/trials/cause.hpp"

namespace flexarm::trials {

Cause torque_bias() {
  return {.name = "torque_bias",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"torque", chance.sign * size * natural.torque_N_m}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.torque_bias_N_m += of.at("torque"); }};
}

}  // namespace flexarm::trials
