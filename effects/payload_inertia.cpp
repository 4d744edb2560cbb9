#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry payload_inertia() {
  return {.definition = define(
              {.name = "payload_inertia",
               .meaning = "additional rotary inertia at the tip, about the centre of mass",
               .parameters = {{.name = "inertia",
                               .unit = "kg m^2",
                               .range = arm::kNotNegative,
                               .meaning = "about the centre of mass",
                               .example = 3e-4,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.tip_inertia_kg_m2 += effect.value("inertia");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double beam_kg_m2 =
                scales.beam_mass_kg() * scales.beam.length_m * scales.beam.length_m;
            return {{"inertia", 1e-5 * beam_kg_m2, 0.3 * beam_kg_m2, Spacing::from_zero}};
          },
          .family = Family::payload_inertia,
          .speaks_for = "tip-acceleration zeros shifted, most at higher modes",
          .refuted_by = "unchanged tip-acceleration zeros"};
}

}  // namespace flexarm::effects
