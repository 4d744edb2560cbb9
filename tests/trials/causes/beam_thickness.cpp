#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// The beam is thicker or thinner in the bending plane than the file says, by 1 to 10 %:
/// EI = E w t^3/12, m = rho w t, and strain is t/2 times the curvature.
Cause beam_thickness() {
  return {.name = "beam_thickness",
          .acts_on = ActsOn::number,
          .largest = 0.1,
          .smallest_part = 0.1,
          .parameters = changed_factor,
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            const double factor = of.at("factor");
            arm.flexural_rigidity_N_m2 *= factor * factor * factor;
            arm.linear_density_kg_per_m *= factor;
            if (arm.thickness_m) *arm.thickness_m *= factor;
          }};
}

}  // namespace flexarm::trials
