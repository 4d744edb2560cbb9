#include "effects/registry/entry.hpp"

#include <cmath>
#include <numbers>
#include <span>

namespace flexarm::effects {

Entry tilt() {
  return {
      .definition = define(
          {.name = "tilt",
           .meaning = "axis that leans: T = tau - amplitude sin(theta - angle), the gravity of the "
                      "rigid arm",
           .parameters = {{.name = "amplitude",
                           .unit = "N m",
                           .range = arm::kNotNegative,
                           .meaning = "mass times distance of its centre from the axis times the "
                                      "part of g across the axis",
                           .example = 0.02,
                           .neutral = 0.0},
                          {.name = "angle",
                           .unit = "rad",
                           .range = arm::kAnyFinite,
                           .meaning = "hub angle at which the arm hangs",
                           .example = 0.7}},
           .hub_torque = [](const arm::Effect& effect) -> arm::HubLaw {
             return arm::SmoothHubTorque{
                 [amplitude_N_m = effect.value("amplitude"), angle_rad = effect.value("angle")](
                     const arm::HubState& hub, std::span<const double> /*z*/,
                     std::span<double> /*rates*/) {
                   return arm::SmoothHubTorque::Value{
                       -amplitude_N_m * std::sin(hub.angle_rad - angle_rad), 0.0};
                 }};
           }}),
      .shows = Shows::in_time,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {{"amplitude", 3e-3 * scales.torque_rms_N_m, 2.0 * scales.torque_rms_N_m,
                 Spacing::from_zero},
                {"angle", 0.0, 2.0 * std::numbers::pi, Spacing::linear, true}};
      },
      // Over a small part of a turn.
      .contains = {"hub_spring", "torque_bias"},
      .family = Family::constant_torque,
      .speaks_for = "residual hub torque of one sine per revolution of the hub",
      .refuted_by = "several periods of the residual hub torque per revolution (that is ripple)"};
}

}  // namespace flexarm::effects
