#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

namespace {

/// Of the typical torque.
constexpr double kTorqueOffsetPart = 0.1;

}  // namespace

/// The amplifier gives a torque at a command of zero.
Dirt torque_offset() {
  return {.name = "torque_offset",
          .named_as = {"torque_bias"},
          .hide = [](double size, const TrialArm& of, const World& world, Random& random) {
            return with_named_dirt(world, of, "torque_bias", size * kTorqueOffsetPart, {}, random);
          }};
}

}  // namespace flexarm::trials
