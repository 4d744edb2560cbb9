#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// Cogging of the motor.
Cause torque_ripple() {
  return {.name = "torque_ripple",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"amplitude", size * natural.torque_N_m},
                    {"cycles", between(2.0, 16.0, chance.place)},
                    {"phase", chance.phase_rad}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(
                    plain_hub_torque([amplitude_N_m = of.at("amplitude"), cycles = of.at("cycles"),
                                      phase_rad = of.at("phase")](const HubStep& step) {
                      return amplitude_N_m * std::sin(cycles * step.angle_rad + phase_rad);
                    }));
              }};
}

}  // namespace flexarm::trials
