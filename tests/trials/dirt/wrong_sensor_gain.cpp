#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

namespace {

/// Logarithm of the factor.
constexpr double kWrongSensorGainSize = 0.15;

}  // namespace

/// The accelerometer's sensitivity is 15 % off.
Dirt wrong_sensor_gain() {
  return {.name = "wrong_sensor_gain",
          .named_as = {"sensor_gain"},
          .hide = [](double size, const TrialArm& of, const World& world, Random& random) {
            return with_named_dirt(world, of, "sensor_gain", size * kWrongSensorGainSize,
                                   "tip_acceleration", random);
          }};
}

}  // namespace flexarm::trials
