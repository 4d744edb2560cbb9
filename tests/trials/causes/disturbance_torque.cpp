#include "tests/trials/cause.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

/// A machine nearby, of which the runs are recorded from the same phase on.
Cause disturbance_torque() {
  return {.name = "disturbance_torque",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"amplitude", size * natural.torque_N_m},
                    {"frequency", between(2.0, 25.0, chance.place)},
                    {"phase", chance.phase_rad}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(plain_hub_torque(
                    [amplitude_N_m = of.at("amplitude"), frequency_Hz = of.at("frequency"),
                     phase_rad = of.at("phase")](const HubStep& step) {
                      const double turns = frequency_Hz * step.time_s;
                      return amplitude_N_m * std::sin(2.0 * std::numbers::pi * turns + phase_rad);
                    }));
              }};
}

}  // namespace flexarm::trials
