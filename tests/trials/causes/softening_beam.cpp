#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// A beam that warms during each run and loses that part of its stiffness, evenly in time.
Cause softening_beam() {
  return {.name = "softening_beam",
          .outside = true,
          .port = "beam",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::beam,
          .largest = 0.6,
          .parameters = [](const NaturalSizes& /*natural*/, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"lost", size}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.softening += of.at("lost"); }};
}

}  // namespace flexarm::trials
