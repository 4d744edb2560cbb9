#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry coulomb_friction() {
  return {
      .definition = define(
          {.name = "coulomb_friction",
           .meaning =
               "hub friction of constant size against the motion; holds the hub at rest below it",
           .parameters = {{.name = "torque",
                           .unit = "N m",
                           .range = arm::kNotNegative,
                           .meaning = "size of the friction",
                           .example = 0.012,
                           .neutral = 0.0}},
           .hub_torque = [](const arm::Effect& effect) -> arm::HubLaw {
             const double torque_N_m = effect.value("torque");
             return arm::DryFriction{[torque_N_m](double /*speed*/) {
               return arm::DryFriction::Size{torque_N_m, 0.0};
             }};
           }}),
      .shows = Shows::in_time,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {{"torque", 3e-3 * scales.torque_rms_N_m, 2.0 * scales.torque_rms_N_m,
                 Spacing::from_zero}};
      },
      .speaks_for =
          "the residual hub torque steps with the sign of the hub velocity, and damping falls with "
          "the amplitude",
      .refuted_by = "damping that is the same at every amplitude"};
}

}  // namespace flexarm::effects
