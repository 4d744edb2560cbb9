#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A spring from the hub to ground.
Cause hub_spring() {
  return {.name = "hub_spring",
          .largest = 3.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"stiffness", size * natural.spring_N_m_per_rad}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.hub_spring_N_m_per_rad += of.at("stiffness"); }};
}

}  // namespace flexarm::trials
