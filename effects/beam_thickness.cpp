#include "effects/registry/entry.hpp"

namespace flexarm::effects {

namespace {

/// EI ~ thickness^3 and m ~ thickness, whichever numbers describe the beam.
void thicken(const arm::Effect& effect, arm::Arm& arm) {
  const double factor = effect.value("factor");
  arm::Beam& beam = arm.beam;
  beam.given_flexural_rigidity_N_m2 = beam.flexural_rigidity_N_m2() * factor * factor * factor;
  beam.given_linear_density_kg_per_m = beam.linear_density_kg_per_m() * factor;
  if (beam.thickness_m) *beam.thickness_m *= factor;
}

}  // namespace

Entry beam_thickness() {
  return {
      .definition = define({.name = "beam_thickness",
                            .meaning = "beam thickness multiplied by factor: EI by factor^3, mass "
                                       "per length and strain by factor",
                            .parameters = {{.name = "factor",
                                            .unit = "1",
                                            .range = arm::kPositive,
                                            .meaning = "factor of the beam thickness",
                                            .example = 1.05,
                                            .neutral = 1.0}},
                            .arm_number = thicken}),
      .shows = Shows::in_all,
      .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
        return {{.name = "factor", .lowest = 0.6, .highest = 1.6, .neutral = 1.0}};
      },
      .prior = Likely::common,
      .usual_deviation = 0.02,
      .family = Family::beam_stiffness,
      .speaks_for =
          "all poles and zeros, and the rigid-body inertia of the beam, changed by the same ratio",
      .refuted_by = "unchanged rigid-body inertia"};
}

}  // namespace flexarm::effects
