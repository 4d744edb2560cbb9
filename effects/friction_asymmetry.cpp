#include "effects/registry/entry.hpp"

#include <cmath>
#include <span>

namespace flexarm::effects {

namespace {

arm::HubLaw one_sided_friction(const arm::Effect& effect) {
  return arm::SmoothHubTorque{
      [coefficient = effect.value("coefficient")](
          const arm::HubState& hub, std::span<const double> /*z*/, std::span<double> /*rates*/) {
        const double speed = hub.velocity_rad_per_s;
        return arm::SmoothHubTorque::Value{-coefficient * std::abs(speed),
                                           -std::copysign(coefficient, speed)};
      }};
}

}  // namespace

Entry friction_asymmetry() {
  return {
      .definition = define(
          {.name = "friction_asymmetry",
           .meaning = "viscous friction of the hub that depends on the direction: T = tau - "
                      "coefficient abs(theta'). With viscous friction of coefficient c it is c + "
                      "coefficient forwards, c - coefficient backwards. Coulomb torques that "
                      "differ between directions are `coulomb_friction` and `torque_bias` "
                      "together",
           .parameters = {{.name = "coefficient",
                           .unit = "N m s/rad",
                           .range = arm::kAnyFinite,
                           .meaning = "half the difference of the viscous coefficients; positive "
                                      "where forward motion is braked more",
                           .example = 0.004,
                           .neutral = 0.0}},
           .hub_torque = one_sided_friction}),
      .shows = Shows::in_time,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        // A part of what stops the rigid arm in the time of a swing at the scale of its modes: what
        // is braked one way is driven the other.
        const double natural =
            arm::total_inertia_kg_m2(scales.beam) * arm::omega_scale_rad_per_s(scales.beam);
        return {{.name = "coefficient",
                 .lowest = -0.3 * natural,
                 .highest = 0.3 * natural,
                 .spacing = Spacing::linear,
                 .neutral = 0.0}};
      },
      .family = Family::viscous_loss,
      .speaks_for =
          "residual hub torque proportional to the size of the hub velocity, of the same sign in "
          "both directions",
      .refuted_by = "the same residual hub torque, but for its sign, in both directions"};
}

}  // namespace flexarm::effects
