#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry hub_radius() {
  return {
      .definition = define(
          {.name = "hub_radius",
           .meaning = "the beam starts at this distance from the axis: y(0) = radius theta",
           .parameters = {{.name = "radius",
                           .unit = "m",
                           .range = arm::kNotNegative,
                           .meaning = "distance from the axis to the beam root",
                           .example = 0.05,
                           .neutral = 0.0}},
           .linear_term =
               [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                 terms.hub_radius_m += effect.value("radius");
               }}),
      .shows = Shows::in_all,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        const double length_m = scales.beam.length_m;
        return {{"radius", 1e-3 * length_m, 0.5 * length_m, Spacing::from_zero}};
      },
      .family = Family::hub_inertia,
      .speaks_for =
          "larger rigid-body inertia, shifted poles, unchanged hub-angle zeros",
      .refuted_by = "shifted hub-angle zeros"};
}

}  // namespace flexarm::effects
