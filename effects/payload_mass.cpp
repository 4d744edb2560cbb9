#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry payload_mass() {
  return {.definition = define(
              {.name = "payload_mass",
               .meaning = "additional mass at the tip, with or without payload",
               .parameters = {{.name = "mass",
                               .unit = "kg",
                               .range = arm::kNotNegative,
                               .meaning = "additional mass",
                               .example = 0.03,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.tip_mass_kg += effect.value("mass");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double beam_kg = scales.beam_mass_kg();
            return {{"mass", 1e-3 * beam_kg, 4.0 * beam_kg, Spacing::from_zero}};
          },
          .prior = Likely::common,
          .family = Family::payload_inertia,
          .speaks_for = "hub-angle zeros shifted, tip-acceleration zeros unchanged",
          .refuted_by = "shifted tip-acceleration zeros"};
}

}  // namespace flexarm::effects
