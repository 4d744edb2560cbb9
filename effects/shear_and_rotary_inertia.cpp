#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"

#include <fmt/format.h>

#include <optional>

namespace flexarm::effects {

namespace {

double known(const std::optional<double>& value, const char* key, const char* unit) {
  if (value) return *value;
  throw arm::InputError(
      fmt::format("{}: missing; effects.shear_and_rotary_inertia needs it [{}]", key, unit), key);
}

void add_shear(const arm::Effect& effect, const arm::Arm& arm, arm::LinearTerms& terms) {
  const double shear_modulus_Pa = known(arm.beam.shear_modulus_Pa, "beam.shear_modulus", "Pa");
  const double width_m = known(arm.beam.width_m, "beam.width", "m");
  const double thickness_m = known(arm.beam.thickness_m, "beam.thickness", "m");
  terms.shear = arm::ShearAndRotaryInertia{
      effect.value("shear_coefficient") * shear_modulus_Pa * width_m * thickness_m,
      arm.beam.linear_density_kg_per_m() * thickness_m * thickness_m / 12.0};
}

}  // namespace

Entry shear_and_rotary_inertia() {
  return {.definition = define({.name = "shear_and_rotary_inertia",
                                .meaning = "Timoshenko beam instead of Euler-Bernoulli; needs "
                                           "`beam.shear_modulus` and the cross-section",
                                .parameters = {{.name = "shear_coefficient",
                                                .unit = "1",
                                                .range = arm::kPositive,
                                                .meaning = "5/6 for a rectangle",
                                                .example = 5.0 / 6.0,
                                                .otherwise = 5.0 / 6.0}},
                                .linear_term = add_shear}),
          .shows = Shows::in_all,
          .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
            return {{"shear_coefficient", 0.05, 2.0}};
          },
          .applies =
              [](const Scales& scales) {
                const arm::Beam& beam = scales.arm.beam;
                return beam.shear_modulus_Pa && beam.width_m && beam.thickness_m;
              },
          .prior = Likely::rare,
          .family = Family::beam_stiffness,
          .speaks_for =
              "natural frequencies below Euler-Bernoulli values, increasingly so for higher modes",
          .refuted_by = "all modes shifted by the same ratio"};
}

}  // namespace flexarm::effects
