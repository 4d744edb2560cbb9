#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// Friction of a gear by its load, which a drive needs more torque to move and less to hold back.
/// The speed over which it builds up is a small
/// part of the one that the typical torque gives the rigid arm in a swing of its slowest mode.
Cause load_friction() {
  return {.name = "load_friction",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          // With all of the load it holds the hub.
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
                      const double part = std::tanh(step.speed_rad_per_s / scale);
                      const bool drives = step.driving_N_m * part > 0.0;
                      const double lost = factor * std::abs(part);
                      const double load = step.driving_N_m / (drives ? 1.0 + lost : 1.0 - lost);
                      return -factor * std::abs(load) * part;
                    }));
              }};
}

}  // namespace flexarm::trials
