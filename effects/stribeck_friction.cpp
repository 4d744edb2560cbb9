#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexarm::effects {

namespace {

/// F(v) = torque + (static_torque - torque) exp(-(v/velocity)^2).
arm::HubLaw stribeck(const arm::Effect& effect) {
  const double kinetic_N_m = effect.value("torque");
  const double fall_N_m = effect.value("static_torque") - kinetic_N_m;
  const double scale = effect.value("velocity");
  if (fall_N_m == 0.0) {
    return arm::DryFriction{[kinetic_N_m](double /*speed*/) {
      return arm::DryFriction::Size{kinetic_N_m, 0.0};
    }};
  }
  return arm::DryFriction{
      [=](double speed) {
        const double relative = speed / scale;
        const double left = fall_N_m * std::exp(-relative * relative);
        return arm::DryFriction::Size{kinetic_N_m + left, -left * 2.0 * relative / scale};
      },
      scale};
}

void require_falling(const arm::Effect& effect, const arm::Arm& /*arm*/) {
  const double kinetic_N_m = effect.value("torque");
  const double static_N_m = effect.value("static_torque");
  if (static_N_m >= kinetic_N_m) return;
  const std::string key = "effects.stribeck_friction.static_torque";
  throw arm::out_of_range(key, static_N_m, "N m",
                          fmt::format("at least effects.stribeck_friction.torque = {} N m",
                                      kinetic_N_m));
}

}  // namespace

Entry stribeck_friction() {
  return {.definition =
              define({.name = "stribeck_friction",
                      .meaning = "hub friction torque + (static_torque - torque) "
                                 "exp(-(theta'/velocity)^2), otherwise as Coulomb",
                      .parameters = {{.name = "torque",
                                      .unit = "N m",
                                      .range = arm::kNotNegative,
                                      .meaning = "Coulomb torque, at high velocity",
                                      .example = 0.01},
                                     {.name = "static_torque",
                                      .unit = "N m",
                                      .range = arm::kNotNegative,
                                      .meaning = "static (breakaway) torque, at rest; at least "
                                                 "`torque`",
                                      .example = 0.016},
                                     {.name = "velocity",
                                      .unit = "rad/s",
                                      .range = arm::kPositive,
                                      .meaning = "Stribeck velocity",
                                      .example = 0.2}},
                      .hub_torque = stribeck,
                      .require_fit = require_falling}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double torque_N_m = scales.torque_rms_N_m;
            const double speed = scales.speed_rms_rad_per_s;
            return {{"torque", 3e-3 * torque_N_m, 2.0 * torque_N_m, Spacing::from_zero},
                    {.name = "static_torque",
                     .lowest = 3e-3 * torque_N_m,
                     .highest = 2.0 * torque_N_m,
                     .spacing = Spacing::from_zero,
                     .above_previous = true},
                    {"velocity", 3e-3 * speed, 3.0 * speed}};
          },
          .contains = {"coulomb_friction"},
          .family = Family::dry_friction,
          .speaks_for =
              "residual hub torque depends on the sign of the hub velocity and is largest near "
              "zero velocity",
          .refuted_by = "a step independent of velocity (that is Coulomb friction)"};
}

}  // namespace flexarm::effects
