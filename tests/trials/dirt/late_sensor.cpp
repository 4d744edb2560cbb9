#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

namespace {

constexpr double kDelay_s = 0.007;

}  // namespace

/// The tip's channel is recorded 7 ms late.
Dirt late_sensor() {
  return {.name = "late_sensor",
          .named_as = {"sensor_delay"},
          .hide = [](double size, const TrialArm& of, const World& world, Random& random) {
            return with_named_dirt(world, of, "sensor_delay", size * kDelay_s, "tip_acceleration",
                                   random);
          }};
}

}  // namespace flexarm::trials
