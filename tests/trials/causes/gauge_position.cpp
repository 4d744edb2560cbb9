#include "tests/trials/cause.hpp"

namespace flexarm::trials {

namespace {

constexpr double kLargestShift = 0.15;
/// The gauge is 50 mm from the hub.
constexpr double kRoomToHub_m = 0.04;

}  // namespace

/// A gauge that is glued elsewhere: further out by a part of the length, or nearer to the hub by a
/// part of the room that there is.
Cause gauge_position() {
  return {.name = "gauge_position",
          .acts_on = ActsOn::sensor,
          .largest = kLargestShift,
          .acts_on_gauge = true,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            const bool is_outwards = chance.sign > 0.0;
            return {{"shift",
                     is_outwards ? size * natural.length_m : -size / kLargestShift * kRoomToHub_m}};
          },
          .change = [](const Parameters& of, const arm::Sensor& sensor,
                       TrueArm& arm) { path_of(arm, sensor).moved_m += of.at("shift"); }};
}

}  // namespace flexarm::trials
