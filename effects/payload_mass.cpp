#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry payload_mass() {
  return {.definition = define(
              {.name = "payload_mass",
               .meaning = "a further mass at the tip, beside the payload where there is one",
               .parameters = {{.name = "mass",
                               .unit = "kg",
                               .range = arm::kNotNegative,
                               .meaning = "of the further body",
                               .example = 0.03,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.tip_mass_kg += effect.value("mass");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double beam_kg = scales.beam_mass_kg();
            return {{"mass", 1e-3 * beam_kg, 2.0 * beam_kg, Spacing::from_zero}};
          },
          .speaks_for = "hub-angle zeros move; zeros of tip acceleration do not",
          .refuted_by = "zeros of tip acceleration that move"};
}

}  // namespace flexarm::effects
