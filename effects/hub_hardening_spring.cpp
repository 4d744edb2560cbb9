#include "effects/registry/entry.hpp"

#include <span>

namespace flexarm::effects {

Entry hub_hardening_spring() {
  return {.definition = define(
              {.name = "hub_hardening_spring",
               .meaning = "T = tau - coefficient theta^3",
               .parameters = {{.name = "coefficient",
                               .unit = "N m/rad^3",
                               .range = arm::kNotNegative,
                               .meaning = "torque per cube of the hub angle",
                               .example = 0.5,
                               .neutral = 0.0}},
               .hub_torque = [](const arm::Effect& effect) -> arm::HubLaw {
                 return arm::SmoothHubTorque{[coefficient = effect.value("coefficient")](
                                                 const arm::HubState& hub,
                                                 std::span<const double> /*z*/,
                                                 std::span<double> /*rates*/) {
                   const double angle = hub.angle_rad;
                   return arm::SmoothHubTorque::Value{-coefficient * angle * angle * angle, 0.0};
                 }};
               }}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double bending = scales.bending_stiffness_N_m_per_rad();
            return {{"coefficient", 1e-4 * bending, 1e3 * bending, Spacing::from_zero}};
          },
          .prior = Likely::rare,
          .family = Family::hub_spring,
          .speaks_for =
              "restoring residual hub torque that grows with the cube of the hub angle; frequency "
              "of slow motion rises with amplitude",
          .refuted_by = "a residual hub torque proportional to the hub angle (that is a spring)"};
}

}  // namespace flexarm::effects
