#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A beam that is thicker at its root than at its tip, or the other way round, by this part of its
/// mean thickness.
Cause tapered_beam() {
  return {.name = "tapered_beam",
          .outside = true,
          .port = "beam",
          .acts_on = ActsOn::beam,
          .largest = 1.2,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& chance) -> Parameters {
            return {{"taper", chance.sign * size}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.taper += of.at("taper"); }};
}

}  // namespace flexarm::trials
