#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A motor on a voltage: what it induces takes torque away.
Cause back_emf() {
  return {.name = "back_emf",
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"constant", size * natural.inertia_kg_m2 * natural.omega_rad_per_s}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.hub_damping_N_m_s_per_rad += of.at("constant"); }};
}

}  // namespace flexarm::trials
