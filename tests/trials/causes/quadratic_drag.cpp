#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// Force per length by the square of the beam's velocity.
Cause quadratic_drag() {
  return {
      .name = "quadratic_drag",
      .shown_in = ShownIn::time,
      .acts_on = ActsOn::beam,
      .largest = 30.0,
      .parameters = [](const NaturalSizes& natural, double size,
                       const Chance& /*chance*/) -> Parameters {
        return {{"coefficient", size * natural.beam_kg / (natural.length_m * natural.length_m)}};
      },
      .change =
          [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            arm.beam_forces_N_per_m.push_back(
                [c = of.at("coefficient")](double v) { return -c * v * std::abs(v); });
          }};
}

}  // namespace flexarm::trials
