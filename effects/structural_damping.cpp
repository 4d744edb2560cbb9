#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry structural_damping() {
  return {.definition = define(
              {.name = "structural_damping",
               .meaning = "additional Kelvin-Voigt (stiffness-proportional) damping of the beam: "
                          "bending moment EI "
                          "(y'' + time d/dt y''); not hysteretic damping with a loss factor",
               .parameters = {{.name = "time",
                               .unit = "s",
                               .range = arm::kNotNegative,
                               .meaning = "time constant, added to damping.kelvin_voigt",
                               .example = 2e-4,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.damping.kelvin_voigt_s += effect.value("time");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double scale_rad_per_s = arm::omega_scale_rad_per_s(scales.beam);
            return {{"time", 1e-3 / scale_rad_per_s, 0.3 / scale_rad_per_s, Spacing::from_zero}};
          },
          .prior = Likely::common,
          .family = Family::beam_dissipation,
          .speaks_for = "damping ratios proportional to natural frequency",
          .refuted_by = "damping ratios that decrease with natural frequency"};
}

}  // namespace flexarm::effects
