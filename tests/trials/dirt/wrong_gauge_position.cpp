#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

namespace {

/// Of the beam's length outwards, or as much of the room towards the hub as that is of 0.15.
constexpr double kWrongGaugePositionSize = 0.06;

}  // namespace

/// The strain gauge is glued elsewhere.
Dirt wrong_gauge_position() {
  return {.name = "wrong_gauge_position",
          .named_as = {"gauge_position"},
          .hide = [](double size, const TrialArm& of, const World& world, Random& random) {
            return with_named_dirt(world, of, "gauge_position", size * kWrongGaugePositionSize, {},
                                   random);
          }};
}

}  // namespace flexarm::trials
