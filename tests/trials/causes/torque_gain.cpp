#include "tests/trials/cause.hpp"

namespace flexarm::trials {

Cause torque_gain() {
  return {.name = "torque_gain",
          .shown_in = ShownIn::time_and_frequency,
          .acts_on = ActsOn::torque_path,
          .parameters = changed_factor,
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            const double factor = of.at("factor");
            arm.torque_curves.push_back(
                {.order = torque_curve_order::kGain,
                 .torque_N_m = [factor](double torque) { return factor * torque; },
                 .slope = factor});
          }};
}

}  // namespace flexarm::trials
