#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"

#include <fmt/format.h>

namespace flexarm::effects {

namespace {

void require_carried(const arm::Effect& effect, const arm::Arm& arm) {
  const double position_m = effect.value("position");
  if (position_m <= arm.beam.length_m) return;
  throw arm::out_of_range(
      "effects.attached_mass.position", position_m, "m",
      fmt::format("0 or more and at most the beam's length, {} m", arm.beam.length_m));
}

}  // namespace

Entry attached_mass() {
  return {.definition = define(
              {.name = "attached_mass",
               .meaning = "point mass fixed to the beam at this position",
               .parameters = {{.name = "mass",
                               .unit = "kg",
                               .range = arm::kNotNegative,
                               .meaning = "mass",
                               .example = 0.04,
                               .neutral = 0.0},
                              {.name = "position",
                               .unit = "m",
                               .range = arm::kNotNegative,
                               .meaning = "distance from the beam root, at most the length",
                               .example = 0.6}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.masses.push_back({effect.value("position"), effect.value("mass")});
                   },
               .require_fit = require_carried}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double beam_kg = scales.beam_mass_kg();
            const double length_m = scales.beam.length_m;
            return {{"mass", 1e-3 * beam_kg, 4.0 * beam_kg, Spacing::from_zero},
                    {"position", 0.05 * length_m, length_m, Spacing::linear}};
          },
          .contains = {"payload_mass"},
          .prior = Likely::rare,
          .family = Family::beam_mass,
          .speaks_for =
              "poles and zeros lowered by different ratios; a mode with a node at the mass "
              "unchanged; tip-acceleration zeros shifted",
          .refuted_by =
              "unchanged tip-acceleration zeros (that is a mass at the tip), or all modes shifted "
              "by the same ratio"};
}

}  // namespace flexarm::effects
