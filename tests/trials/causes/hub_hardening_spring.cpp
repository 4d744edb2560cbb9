#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A torque -coefficient theta^3.
Cause hub_hardening_spring() {
  return {.name = "hub_hardening_spring",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .largest = 300.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"coefficient", size * natural.spring_N_m_per_rad}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(
                    plain_hub_torque([c = of.at("coefficient")](const HubStep& step) {
                      return -c * step.angle_rad * step.angle_rad * step.angle_rad;
                    }));
              }};
}

}  // namespace flexarm::trials
