#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"
#include "effects/registry/rotational_spring.hpp"

#include <fmt/format.h>

namespace flexarm::effects {

namespace {

void require_on_beam(const arm::Effect& effect, const arm::Arm& arm) {
  const double position_m = effect.value("position");
  if (position_m < arm.beam.length_m) return;
  throw arm::out_of_range(
      "effects.local_stiffness_loss.position", position_m, "m",
      fmt::format("0 or more and less than the beam's length, {} m", arm.beam.length_m));
}

}  // namespace

Entry local_stiffness_loss() {
  return {.definition = define(
              {.name = "local_stiffness_loss",
               .meaning = "crack: massless rotational spring in the beam at this position",
               .parameters = {{.name = "position",
                               .unit = "m",
                               .range = arm::kNotNegative,
                               .meaning = "distance from the beam root, less than the length",
                               .example = 0.31},
                              rotational_stiffness(15.0)},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.springs.push_back({effect.value("position"), effect.value("stiffness")});
                   },
               .require_fit = require_on_beam}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double length_m = scales.beam.length_m;
            return {{"position", 0.01 * length_m, 0.99 * length_m, Spacing::linear},
                    searched_stiffness(scales, 300.0)};
          },
          .contains = {"root_compliance"},
          .prior = Likely::rare,
          .family = Family::beam_stiffness,
          .speaks_for =
              "poles and zeros lowered by different ratios; a mode without curvature at the crack "
              "unchanged",
          .refuted_by = "all modes shifted by the same ratio"};
}

}  // namespace flexarm::effects
