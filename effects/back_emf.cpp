#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry back_emf() {
  return {.definition = define(
              {.name = "back_emf",
               .meaning = "torque commanded as a voltage: T = tau - constant theta'",
               .parameters = {{.name = "constant",
                               .unit = "N m s/rad",
                               .range = arm::kNotNegative,
                               .meaning = "product of torque constant and voltage constant over "
                                          "the armature's resistance, at the hub",
                               .example = 0.012,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.damping.hub_N_m_s_per_rad += effect.value("constant");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            // Up to what stops the rigid arm in the time of a swing at the scale of its modes.
            const double natural =
                arm::total_inertia_kg_m2(scales.beam) * arm::omega_scale_rad_per_s(scales.beam);
            return {{"constant", 1e-3 * natural, 3.0 * natural, Spacing::from_zero}};
          },
          .same_as = {"hub_viscous_friction"},
          .family = Family::viscous_loss,
          .speaks_for =
              "residual hub torque proportional to hub velocity where the torque is commanded as a "
              "voltage",
          .refuted_by = "a torque that is measured, or set by a current loop"};
}

}  // namespace flexarm::effects
