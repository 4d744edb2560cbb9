#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry payload_offset() {
  return {.definition = define(
              {.name = "payload_offset",
               .meaning = "distance of the payload's centre of mass beyond the tip",
               .parameters = {{.name = "offset",
                               .unit = "m",
                               .range = arm::kAnyFinite,
                               .meaning = "distance from the tip, outwards",
                               .example = 0.04,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.payload_offset_m += effect.value("offset");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double reach_m = 0.3 * scales.beam.length_m;
            return {{.name = "offset",
                     .lowest = -reach_m,
                     .highest = reach_m,
                     .spacing = Spacing::linear,
                     .neutral = 0.0}};
          },
          .applies = [](const Scales& scales) { return scales.has_payload_mass; },
          .family = Family::payload_inertia,
          .speaks_for = "residuals increase with payload and vanish without payload",
          .refuted_by = "excess residual without payload"};
}

}  // namespace flexarm::effects
