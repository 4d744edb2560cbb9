#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// Viscous friction that is larger one way than the other. Small: of the arm's own there is little,
/// and what is less than none drives the arm.
Cause friction_asymmetry() {
  return {.name = "friction_asymmetry",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .largest = 0.05,
          .smallest_part = 1e-4,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"coefficient",
                     chance.sign * size * natural.inertia_kg_m2 * natural.omega_rad_per_s}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(
                    plain_hub_torque([c = of.at("coefficient")](const HubStep& step) {
                      return -c * std::abs(step.speed_rad_per_s);
                    }));
              }};
}

}  // namespace flexarm::trials
