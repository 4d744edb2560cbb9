#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"

#include <cmath>
#include <span>

namespace flexarm::effects {

namespace {

/// T = tau - factor |L| p, p = tanh(theta'/velocity), of a load L that the drive holds against
/// friction: L = tau/(1 + factor p sign(tau)).
arm::HubLaw friction_by_load(const arm::Effect& effect) {
  return arm::SmoothHubTorque{
      [factor = effect.value("factor"), scale = effect.value("velocity")](
          const arm::HubState& hub, std::span<const double> /*z*/, std::span<double> /*rates*/) {
        const double size_N_m = factor * std::abs(hub.torque_N_m);
        const double part = std::tanh(hub.velocity_rad_per_s / scale);
        const double over_load = 1.0 + std::copysign(factor * part, part * hub.torque_N_m);
        return arm::SmoothHubTorque::Value{
            -size_N_m * part / over_load,
            -size_N_m * (1.0 - part * part) / (scale * over_load * over_load)};
      }};
}

/// A gear with a factor of 1 or more cannot be driven by its load.
void require_motion(const arm::Effect& effect, const arm::Arm& /*arm*/) {
  const double factor = effect.value("factor");
  if (factor < 1.0) return;
  throw arm::out_of_range("effects.load_friction.factor", factor, "1", "below 1");
}

}  // namespace

Entry load_friction() {
  return {
      .definition = define(
          {.name = "load_friction",
           .meaning = "friction of a gear that grows with its load: T = tau - factor abs(L) p, p = "
                      "tanh(theta'/velocity), L = tau/(1 + factor p sign(tau)). It helps a torque "
                      "that brakes and hinders one that drives",
           .parameters = {{.name = "factor",
                           .unit = "1",
                           .range = arm::kNotNegative,
                           .meaning = "friction torque over the torque of the load; below 1",
                           .example = 0.15,
                           .neutral = 0.0},
                          {.name = "velocity",
                           .unit = "rad/s",
                           .range = arm::kPositive,
                           .meaning = "velocity of the hub at which it has three quarters of its "
                                      "size",
                           .example = 0.05}},
           .hub_torque = friction_by_load,
           .require_fit = require_motion}),
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
