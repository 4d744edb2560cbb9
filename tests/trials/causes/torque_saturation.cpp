#include "tests/trials/cause.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::trials {

Cause torque_saturation() {
  return {.name = "torque_saturation",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::torque_path,
          .largest = 3.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"limit", natural.peak_N_m * std::exp(-size)}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.torque_curves.push_back(
                    {.order = torque_curve_order::kSaturation,
                     .torque_N_m = [limit_N_m = of.at("limit")](double torque) {
                       return std::copysign(std::min(std::abs(torque), limit_N_m), torque);
                     }});
              }};
}

}  // namespace flexarm::trials
