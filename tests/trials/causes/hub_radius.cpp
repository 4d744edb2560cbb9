#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// The beam begins away from the axis.
Cause hub_radius() {
  return {.name = "hub_radius",
          .largest = 0.3,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"radius", size * natural.length_m}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.hub_radius_m += of.at("radius"); }};
}

}  // namespace flexarm::trials
