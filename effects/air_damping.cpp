#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry air_damping() {
  return {.definition = define(
              {.name = "air_damping",
               .meaning = "force per length -coefficient dy/dt",
               .parameters = {{.name = "coefficient",
                               .unit = "N s/m^2",
                               .range = arm::kNotNegative,
                               .meaning = "force per length and velocity",
                               .example = 0.05,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.damping.air_N_s_per_m2 += effect.value("coefficient");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double natural =
                scales.beam.linear_density_kg_per_m * arm::omega_scale_rad_per_s(scales.beam);
            return {{"coefficient", 1e-3 * natural, 6.0 * natural, Spacing::from_zero}};
          },
          .speaks_for =
              "damping ratios of poles and zeros inversely proportional to natural frequency",
          .refuted_by = "damping ratios that increase with natural frequency"};
}

}  // namespace flexarm::effects
