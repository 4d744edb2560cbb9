#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"

#include <fmt/format.h>

#include <numbers>

namespace flexarm::effects {

namespace {

void require_suspended(const arm::Effect& effect, const arm::Arm& arm) {
  const double position_m = effect.value("position");
  if (position_m <= arm.beam.length_m) return;
  throw arm::out_of_range(
      "effects.tuned_mass.position", position_m, "m",
      fmt::format("above 0 and at most the beam's length, {} m", arm.beam.length_m));
}

void add_suspended_mass(const arm::Effect& effect, const arm::Arm& /*arm*/,
                        arm::LinearTerms& terms) {
  const double mass_kg = effect.value("mass");
  const double omega_rad_per_s = 2.0 * std::numbers::pi * effect.value("frequency");
  terms.masses.push_back(
      {effect.value("position"), mass_kg,
       arm::Suspension{mass_kg * omega_rad_per_s * omega_rad_per_s,
                       2.0 * effect.value("damping_ratio") * omega_rad_per_s * mass_kg}});
}

}  // namespace

Entry tuned_mass() {
  return {
      .definition = define(
          {.name = "tuned_mass",
           .meaning = "mass on a spring k and a dashpot c across the beam at this position: k = "
                      "mass (2 pi frequency)^2, c = 4 pi damping_ratio mass frequency. Its "
                      "force on the beam is -mass s^2 (c s + k)/(mass s^2 + c s + k) y",
           .parameters = {{.name = "mass",
                           .unit = "kg",
                           .range = arm::kNotNegative,
                           .meaning = "mass",
                           .example = 0.01,
                           .neutral = 0.0},
                          {.name = "frequency",
                           .unit = "Hz",
                           .range = arm::kPositive,
                           .meaning = "natural frequency of the mass on a beam at rest, "
                                      "undamped",
                           .example = 14.0},
                          {.name = "damping_ratio",
                           .unit = "1",
                           .range = arm::kNotNegative,
                           .meaning = "damping ratio of the mass on a beam at rest",
                           .example = 0.03},
                          {.name = "position",
                           .unit = "m",
                           .range = arm::kPositive,
                           .meaning = "distance from the beam root, at most the length",
                           .example = 0.75}},
           .linear_term = add_suspended_mass,
           .require_fit = require_suspended}),
      .shows = Shows::in_all,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        const double beam_kg = scales.beam_mass_kg();
        const double length_m = scales.beam.length_m;
        // From a fifth of the first pole of a hub without inertia to ten times it.
        const double first_Hz =
            15.4 * arm::omega_scale_rad_per_s(scales.beam) / (2.0 * std::numbers::pi);
        return {{"mass", 1e-3 * beam_kg, 4.0 * beam_kg, Spacing::from_zero},
                {"frequency", 0.2 * first_Hz, 10.0 * first_Hz},
                {"damping_ratio", 1e-3, 1.0},
                {"position", 0.05 * length_m, length_m, Spacing::linear}};
      },
      .contains = {"attached_mass"},
      .prior = Likely::rare,
      .family = Family::beam_mass,
      .speaks_for =
          "one pole more than the beam has, and with it one zero of the hub angle; a notch in "
          "the response at the mass's own frequency",
      .refuted_by = "as many poles as the beam has, each shifted alone (that is a fixed mass)"};
}

}  // namespace flexarm::effects
