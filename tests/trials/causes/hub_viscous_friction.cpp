#include "tests/trials/cause.hpp"

namespace flexarm::trials {

Cause hub_viscous_friction() {
  return {.name = "hub_viscous_friction",
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"coefficient", size * natural.inertia_kg_m2 * natural.omega_rad_per_s}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.hub_damping_N_m_s_per_rad += of.at("coefficient"); }};
}

}  // namespace flexarm::trials
