#include "effects/registry/entry.hpp"

#include <cmath>
#include <span>

namespace flexarm::effects {

namespace {

/// Friction that comes up over less than this angle comes up at once: sensors show no less, and
/// time steps would be as short.
constexpr double kNoPresliding_rad = 1e-4;

/// Dahl's model [Dahl1968] in s = friction/torque, from 0 at the first sample:
///
///     s' = stiffness/torque (theta' - |theta'| s),   T = -torque s.
arm::HubLaw dahl_friction(const arm::Effect& effect) {
  const double torque_N_m = effect.value("torque");
  const double stiffness = effect.value("stiffness");
  if (torque_N_m < kNoPresliding_rad * stiffness) {
    return arm::DryFriction{[torque_N_m](double /*speed*/) {
      return arm::DryFriction::Size{torque_N_m, 0.0};
    }};
  }
  const double per_angle = stiffness / torque_N_m;
  return arm::SmoothHubTorque{
      .law =
          [torque_N_m, per_angle](const arm::HubState& hub, std::span<const double> z,
                                  std::span<double> rates) {
            const double speed = hub.velocity_rad_per_s;
            rates[0] = per_angle * (speed - std::abs(speed) * z[0]);
            return arm::SmoothHubTorque::Value{-torque_N_m * z[0], 0.0};
          },
      .states = 1,
      .after_turn =
          [per_angle](double turn_rad, std::span<const double> z, std::span<double> after) {
            const double steady = std::copysign(1.0, turn_rad);
            after[0] = steady + (z[0] - steady) * std::exp(-per_angle * std::abs(turn_rad));
          }};
}

}  // namespace

Entry hub_hysteresis() {
  return {.definition = define(
              {.name = "hub_hysteresis",
               .meaning = "hub friction F with presliding: dF/dtheta = stiffness (1 - F "
                          "sign(theta')/torque) [Dahl1968]; T = -F, F = 0 at the first sample. "
                          "Where torque/stiffness is below 1e-4 rad it is Coulomb friction",
               .parameters = {{.name = "torque",
                               .unit = "N m",
                               .range = arm::kNotNegative,
                               .meaning = "Coulomb torque, which F approaches in steady motion",
                               .example = 0.012,
                               .neutral = 0.0},
                              {.name = "stiffness",
                               .unit = "N m/rad",
                               .range = arm::kPositive,
                               .meaning = "dF/dtheta where F = 0; twice that behind a reversal of "
                                          "steady motion",
                               .example = 0.4}},
               .hub_torque = dahl_friction}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double torque_N_m = scales.torque_rms_N_m;
            return {{"torque", 3e-3 * torque_N_m, 3.0 * torque_N_m, Spacing::from_zero},
                    {"stiffness", 0.1 * torque_N_m, 1e3 * torque_N_m}};
          },
          // At infinite stiffness; and at infinite torque.
          .contains = {"coulomb_friction", "hub_spring"},
          .prior = Likely::rare,
          .family = Family::dry_friction,
          .speaks_for =
              "residual hub torque that reverses over an angle, not at once, where the hub "
              "velocity changes its sign",
          .refuted_by =
              "a hub that sticks, or a residual hub torque that reverses at once (that is Coulomb "
              "friction)"};
}

}  // namespace flexarm::effects
