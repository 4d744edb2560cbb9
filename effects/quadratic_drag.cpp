#include "effects/registry/entry.hpp"

#include <cmath>
#include <cstddef>
#include <span>

namespace flexarm::effects {

Entry quadratic_drag() {
  return {.definition =
              define({.name = "quadratic_drag",
                      .meaning = "force per length -coefficient abs(v) v, v = dy/dt",
                      .parameters = {{.name = "coefficient",
                                      .unit = "N s^2/m^3",
                                      .range = arm::kNotNegative,
                                      .meaning = "force per length and square of velocity",
                                      .example = 0.3,
                                      .neutral = 0.0}},
                      .beam_force =
                          [](const arm::Effect& effect) {
                            const double coefficient = effect.value("coefficient");
                            return arm::BeamForce{[coefficient](std::span<const double> v_m_per_s,
                                                                std::span<double> force_N_per_m) {
                              for (std::size_t i = 0; i < v_m_per_s.size(); ++i) {
                                const double v = v_m_per_s[i];
                                force_N_per_m[i] -= coefficient * std::abs(v) * v;
                              }
                            }};
                          }}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales)
              -> std::vector<SearchedParameter> {  // As heavy as the beam's inertia over the way of
                                                   // its tip.
            const double natural = scales.beam.linear_density_kg_per_m / scales.beam.length_m;
            return {{"coefficient", 1e-3 * natural, 60.0 * natural, Spacing::from_zero}};
          },
          .speaks_for = "apparent damping increases with amplitude",
          .refuted_by = "apparent damping independent of amplitude"};
}

}  // namespace flexarm::effects
