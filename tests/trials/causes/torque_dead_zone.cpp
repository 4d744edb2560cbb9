#include "tests/trials/cause.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::trials {

Cause torque_dead_zone() {
  return {.name = "torque_dead_zone",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::torque_path,
          .largest = 2.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"width", size * natural.torque_N_m}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.torque_curves.push_back(
                    {.order = torque_curve_order::kDeadZone,
                     .torque_N_m = [width_N_m = of.at("width")](double torque) {
                       return std::copysign(std::max(0.0, std::abs(torque) - width_N_m), torque);
                     }});
              }};
}

}  // namespace flexarm::trials
