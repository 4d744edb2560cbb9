#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/entry.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexarm::effects {

namespace {

/// Relative to m sqrt(EI/(m l^4)): beyond, the wave number at the tenth pole's frequency is 1e4 and
/// more, which exact_tf divides into too many segments.
constexpr double kLargestAirDampingRatio = 1e12;

void require_waves(const arm::Effect& effect, const arm::Arm& arm) {
  if (!arm::has_beam(arm)) return;
  const double length_m = arm.beam.length_m;
  const double natural =
      std::sqrt(arm.beam.flexural_rigidity_N_m2() * arm.beam.linear_density_kg_per_m()) /
      (length_m * length_m);
  const double coefficient = effect.value("coefficient");
  // Not a number where the beam's own numbers overflow.
  if (!(coefficient > kLargestAirDampingRatio * natural)) return;
  throw arm::out_of_range("effects.air_damping.coefficient", coefficient, "N s/m^2",
                          fmt::format("{:.6g} or less, {:g} times m sqrt(EI/(m l^4))",
                                      kLargestAirDampingRatio * natural, kLargestAirDampingRatio));
}

}  // namespace

Entry air_damping() {
  return {
      .definition = define(
          {.name = "air_damping",
           .meaning = "force per length -coefficient dy/dt",
           .parameters = {{.name = "coefficient",
                           .unit = "N s/m^2",
                           .range = arm::kNotNegative,
                           .meaning = "force per length and velocity",
                           .example = 0.05,
                           .neutral = 0.0}},
           .linear_term =
               [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                 terms.damping.air_N_s_per_m2 += effect.value("coefficient");
               },
           .require_fit = require_waves}),
      .shows = Shows::in_all,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        const double natural =
            scales.beam.linear_density_kg_per_m * arm::omega_scale_rad_per_s(scales.beam);
        return {{"coefficient", 1e-3 * natural, 6.0 * natural, Spacing::from_zero}};
      },
      .family = Family::beam_dissipation,
      .speaks_for = "damping ratios of poles and zeros inversely proportional to natural frequency",
      .refuted_by = "damping ratios that increase with natural frequency"};
}

}  // namespace flexarm::effects
