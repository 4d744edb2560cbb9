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
                            return arm::BeamForce{
                                [coefficient](std::span<const double> v, std::span<double> forces) {
                                  for (std::size_t i = 0; i < v.size(); ++i) {
                                    forces[i] -= coefficient * std::abs(v[i]) * v[i];
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
