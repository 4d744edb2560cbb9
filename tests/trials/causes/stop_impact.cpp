#include "tests/trials/cause.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

/// The rigid arm is in contact for so long.
constexpr double kContact_s = 0.03;
constexpr double kStopImpactDampingRatio = 0.1;

}  // namespace

/// Elastic stops on either side of the hub: of size 1 at the angle that the typical torque turns
/// the rigid arm by in a second, and nearer the larger it is.
Cause stop_impact() {
  return {.name = "stop_impact",
          .outside = true,
          .port = "hub",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .largest = 50.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            const double omega = std::numbers::pi / kContact_s;
            const double stiffness = natural.inertia_kg_m2 * omega * omega;
            return {{"angle", 0.5 * natural.torque_N_m / natural.inertia_kg_m2 / size},
                    {"stiffness", stiffness},
                    {"damping", 2.0 * kStopImpactDampingRatio * stiffness / omega}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(plain_hub_torque([of](const HubStep& step) {
                  const double beyond = std::abs(step.angle_rad) - of.at("angle");
                  if (beyond <= 0.0) return 0.0;
                  const double sign = std::copysign(1.0, step.angle_rad);
                  const double push =
                      of.at("stiffness") * beyond + of.at("damping") * sign * step.speed_rad_per_s;
                  return -sign * std::max(push, 0.0);
                }));
              }};
}

}  // namespace flexarm::trials
