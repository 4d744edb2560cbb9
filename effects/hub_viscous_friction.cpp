#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry hub_viscous_friction() {
  return {.definition = define(
              {.name = "hub_viscous_friction",
               .meaning = "additional viscous torque -coefficient theta' at the hub",
               .parameters = {{.name = "coefficient",
                               .unit = "N m s/rad",
                               .range = arm::kNotNegative,
                               .meaning = "torque per angular velocity",
                               .example = 0.01,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.damping.hub_N_m_s_per_rad += effect.value("coefficient");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales)
              -> std::vector<SearchedParameter> {  // It stops the rigid arm in the time of a swing
                                                   // at the scale of its modes.
            const double natural =
                arm::total_inertia_kg_m2(scales.beam) * arm::omega_scale_rad_per_s(scales.beam);
            return {{"coefficient", 1e-3 * natural, 3.0 * natural, Spacing::from_zero}};
          },
          .prior = Likely::common,
          .family = Family::viscous_loss,
          .speaks_for =
              "residual hub torque proportional to hub velocity, with the same coefficient at "
              "every amplitude",
          .refuted_by =
              "a coefficient that depends on amplitude, or a step of the residual hub torque at "
              "zero velocity"};
}

}  // namespace flexarm::effects
