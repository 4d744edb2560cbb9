#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry coulomb_friction() {
  return {
      .definition = define(
          {.name = "coulomb_friction",
           .meaning =
               "Coulomb friction at the hub; sticks below this torque",
           .parameters = {{.name = "torque",
                           .unit = "N m",
                           .range = arm::kNotNegative,
                           .meaning = "friction torque",
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
        return {{"torque", 3e-3 * scales.torque_rms_N_m, 3.0 * scales.torque_rms_N_m,
                 Spacing::from_zero}};
      },
      .prior = Likely::common,
      .family = Family::dry_friction,
      .speaks_for =
          "residual hub torque depends on the sign of the hub velocity; apparent damping decreases "
          "with amplitude",
      .refuted_by = "apparent damping independent of amplitude"};
}

}  // namespace flexarm::effects
