#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// An axis that is not plumb: the arm hangs at an angle of the hub.
Cause tilt() {
  return {.name = "tilt",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"amplitude", size * natural.torque_N_m}, {"angle", chance.phase_rad}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(
                    plain_hub_torque([weight_N_m = of.at("amplitude"),
                                      hanging_rad = of.at("angle")](const HubStep& step) {
                      return weight_N_m * std::sin(hanging_rad - step.angle_rad);
                    }));
              }};
}

}  // namespace flexarm::trials
