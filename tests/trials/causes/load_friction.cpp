#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// Friction of a gear by the torque that it carries. The speed over which it builds up is a small
/// part of the one that the typical torque gives the rigid arm in a swing of its slowest mode.
Cause load_friction() {
  return {.name = "load_friction",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          // With all of the torque it holds the hub.
          .largest = 0.6,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            const double speed =
                natural.torque_N_m / (natural.inertia_kg_m2 * natural.omega_rad_per_s);
            return {{"factor", size}, {"velocity", speed * between(0.02, 0.1, chance.place)}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(plain_hub_torque(
                    [factor = of.at("factor"), scale = of.at("velocity")](const HubStep& step) {
                      return -factor * std::abs(step.driving_N_m) *
                             std::tanh(step.speed_rad_per_s / scale);
                    }));
              }};
}

}  // namespace flexarm::trials
