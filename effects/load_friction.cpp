#include "effects/registry/entry.hpp"

#include <cmath>
#include <span>

namespace flexarm::effects {

namespace {

/// T = tau - factor |tau| tanh(theta'/velocity).
arm::HubLaw friction_by_load(const arm::Effect& effect) {
  return arm::SmoothHubTorque{[factor = effect.value("factor"), scale = effect.value("velocity")](
                                  const arm::HubState& hub, std::span<const double> /*z*/,
                                  std::span<double> /*rates*/) {
    const double size_N_m = factor * std::abs(hub.torque_N_m);
    const double part = std::tanh(hub.velocity_rad_per_s / scale);
    return arm::SmoothHubTorque::Value{-size_N_m * part, -size_N_m * (1.0 - part * part) / scale};
  }};
}

}  // namespace

Entry load_friction() {
  return {
      .definition = define(
          {.name = "load_friction",
           .meaning = "friction of a gear that grows with the torque it carries: T = tau - factor "
                      "abs(tau) tanh(theta'/velocity). It helps a torque that brakes and hinders "
                      "one that drives",
           .parameters = {{.name = "factor",
                           .unit = "1",
                           .range = arm::kNotNegative,
                           .meaning = "friction torque over the torque of the drive",
                           .example = 0.15,
                           .neutral = 0.0},
                          {.name = "velocity",
                           .unit = "rad/s",
                           .range = arm::kPositive,
                           .meaning = "velocity of the hub at which it has three quarters of its "
                                      "size",
                           .example = 0.05}},
           .hub_torque = friction_by_load}),
      .shows = Shows::in_time,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        const double speed = scales.speed_rms_rad_per_s;
        return {{"factor", 0.003, 0.7, Spacing::from_zero},
                {"velocity", 3e-3 * speed, 0.3 * speed}};
      },
      .family = Family::dry_friction,
      .speaks_for =
          "residual hub torque against the motion, in proportion to the size of the torque; the "
          "arm seems driven by less torque than it is braked by",
      .refuted_by = "residual hub torque against the motion where the drive has no torque"};
}

}  // namespace flexarm::effects
