#include "effects/registry/entry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace flexarm::effects {

namespace {

constexpr double kFewestCycles = 1.5;
constexpr double kMostCycles = 40.0;

/// Of the ripple, over the largest motion of a run. Over less the sine is within 2 % a torque bias
/// and a spring.
constexpr double kLeastPhase_rad = 0.5;

double fewest_cycles(const Scales& scales) {
  if (scales.hub_angle_range_rad == 0.0) return kFewestCycles;
  return std::max(kFewestCycles, kLeastPhase_rad / scales.hub_angle_range_rad);
}

}  // namespace

Entry torque_ripple() {
  return {.definition = define(
              {.name = "torque_ripple",
               .meaning = "T = tau + amplitude sin(cycles theta + phase)",
               .parameters = {{.name = "amplitude",
                               .unit = "N m",
                               .range = arm::kAnyFinite,
                               .meaning = "amplitude of the ripple",
                               .example = 0.01,
                               .neutral = 0.0},
                              {.name = "cycles",
                               .unit = "1/rev",
                               .range = arm::kPositive,
                               .meaning = "cycles per revolution (theta in rad)",
                               .example = 9.0},
                              {.name = "phase",
                               .unit = "rad",
                               .range = arm::kAnyFinite,
                               .meaning = "phase at theta = 0",
                               .example = 0.4}},
               .hub_torque = [](const arm::Effect& effect) -> arm::HubLaw {
                 return arm::SmoothHubTorque{
                     [amplitude_N_m = effect.value("amplitude"), cycles = effect.value("cycles"),
                      phase_rad = effect.value("phase")](const arm::HubState& hub,
                                                         std::span<const double> /*z*/,
                                                         std::span<double> /*rates*/) {
                       return arm::SmoothHubTorque::Value{
                           amplitude_N_m * std::sin(cycles * hub.angle_rad + phase_rad), 0.0};
                     }};
               }}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            return {{"amplitude", 3e-3 * scales.torque_rms_N_m, 2.0 * scales.torque_rms_N_m,
                     Spacing::from_zero},
                    {"cycles", fewest_cycles(scales), kMostCycles},
                    {"phase", 0.0, 2.0 * std::numbers::pi, Spacing::linear, true}};
          },
          .applies = [](const Scales& scales) { return fewest_cycles(scales) < kMostCycles; },
          // Of few cycles, over a part of a turn.
          .contains = {"hub_spring", "torque_bias"},
          .prior = Likely::rare,
          .family = Family::constant_torque,
          .speaks_for = "residual hub torque periodic in the hub angle",
          .refuted_by = "a residual hub torque at the same angle that differs between revolutions"};
}

}  // namespace flexarm::effects
