#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry gravity() {
  return {.definition = define(
              {.name = "gravity",
               .meaning = "the arm hangs along gravity: axial tension P(x) = acceleration (mass "
                          "beyond x), potential 1/2 integral P y'^2 dx; negative: inverted arm",
               .parameters = {{.name = "acceleration",
                               .unit = "m/s^2",
                               .range = arm::kAnyFinite,
                               .meaning = "component along the arm, from hub to tip",
                               .example = 9.81,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.gravity_m_per_s2 += effect.value("acceleration");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
            // The earth's, hanging or upright, and a tenth for masses that are off.
            constexpr double kMost_m_per_s2 = 1.1 * 9.81;
            return {{.name = "acceleration",
                     .lowest = -kMost_m_per_s2,
                     .highest = kMost_m_per_s2,
                     .spacing = Spacing::linear,
                     .neutral = 0.0}};
          },
          .family = Family::constant_torque,
          .speaks_for =
              "restoring torque towards one hub angle; squared pole frequencies all increased by "
              "nearly the same amount",
          .refuted_by = "equilibrium at any hub angle"};
}

}  // namespace flexarm::effects
