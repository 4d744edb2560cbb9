#include "tests/trials/cause.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

constexpr double kMovingBaseDampingRatio = 0.04;

}  // namespace

/// The table that carries the motor turns on its feet. Of size 1 its inertia is that of the arm.
Cause moving_base() {
  return {
      .name = "moving_base",
      .outside = true,
      .port = "sensor hub_angle+hub_velocity",
      .shown_in = ShownIn::time,
      .acts_on = ActsOn::hub,
      .largest = 3.0,
      .parameters = [](const NaturalSizes& natural, double size,
                       const Chance& chance) -> Parameters {
        const double omega = 2.0 * std::numbers::pi * between(3.0, 15.0, chance.place);
        const double inertia = natural.inertia_kg_m2 / size;
        return {{"inertia", inertia},
                {"stiffness", inertia * omega * omega},
                {"damping", 2.0 * kMovingBaseDampingRatio * inertia * omega}};
      },
      .change =
          [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            arm.base = TrueArm::TurningBase{of.at("inertia"), of.at("stiffness"), of.at("damping")};
          }};
}

}  // namespace flexarm::trials
