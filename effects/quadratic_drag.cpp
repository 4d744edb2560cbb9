#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/entry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <span>

namespace flexarm::effects {

namespace {

/// Drag relative to the beam's linear density over its length. Steps shorten as its root: at this
/// ratio a simulation takes a minute, and the arm stops within 1e-9 of its length.
constexpr double kLargestDragRatio = 1e9;

void require_resolved(const arm::Effect& effect, const arm::Arm& arm) {
  if (!arm::has_beam(arm)) return;
  const double largest = kLargestDragRatio * arm.beam.linear_density_kg_per_m() / arm.beam.length_m;
  const double coefficient = effect.value("coefficient");
  if (!(coefficient > largest)) return;
  throw arm::out_of_range(
      "effects.quadratic_drag.coefficient", coefficient, "N s^2/m^3",
      fmt::format("{:.6g} or less, {:g} times the beam's linear density over its length", largest,
                  kLargestDragRatio));
}

}  // namespace

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
                          },
                      .require_fit = require_resolved}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales)
              -> std::vector<SearchedParameter> {  // As heavy as the beam's inertia over the way of
                                                   // its tip.
            const double natural = scales.beam.linear_density_kg_per_m / scales.beam.length_m;
            return {{"coefficient", 1e-3 * natural, 60.0 * natural, Spacing::from_zero}};
          },
          .prior = Likely::rare,
          .family = Family::beam_dissipation,
          .speaks_for = "apparent damping increases with amplitude",
          .refuted_by = "apparent damping independent of amplitude"};
}

}  // namespace flexarm::effects
