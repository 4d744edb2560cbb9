#include "effects/registry/entry.hpp"

#include <cmath>
#include <numbers>
#include <span>

namespace flexarm::effects {

namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

arm::HubLaw harmonic_torque(const arm::Effect& effect) {
  return arm::SmoothHubTorque{
      .law =
          [amplitude_N_m = effect.value("amplitude"),
           omega_rad_per_s = kTurn_rad * effect.value("frequency"),
           phase_rad = effect.value("phase")](const arm::HubState& hub,
                                              std::span<const double> /*z*/,
                                              std::span<double> /*rates*/) {
            return arm::SmoothHubTorque::Value{
                amplitude_N_m * std::sin(omega_rad_per_s * hub.time_s + phase_rad), 0.0};
          },
      .depends_on_time = true};
}

}  // namespace

Entry disturbance_torque() {
  return {
      .definition =
          define({.name = "disturbance_torque",
                  .meaning = "T = tau + amplitude sin(2 pi frequency t + phase), t from the "
                             "first sample of each run",
                  .parameters = {{.name = "amplitude",
                                  .unit = "N m",
                                  .range = arm::kNotNegative,
                                  .meaning = "amplitude of the torque",
                                  .example = 0.01,
                                  .neutral = 0.0},
                                 {.name = "frequency",
                                  .unit = "Hz",
                                  .range = arm::kPositive,
                                  .meaning = "frequency",
                                  .example = 6.0},
                                 {.name = "phase",
                                  .unit = "rad",
                                  .range = arm::kAnyFinite,
                                  .meaning = "phase at the first sample, the same in all runs",
                                  .example = 0.4}},
                  .hub_torque = harmonic_torque}),
      .shows = Shows::in_time,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        // Up to half the Nyquist frequency.
        return {{"amplitude", 3e-3 * scales.torque_rms_N_m, 2.0 * scales.torque_rms_N_m,
                 Spacing::from_zero},
                {"frequency", 1e-3 / scales.shortest_time_s, 0.125 / scales.shortest_time_s},
                {"phase", 0.0, kTurn_rad, Spacing::linear, true}};
      },
      .prior = Likely::rare,
      .family = Family::disturbance,
      .speaks_for = "residual hub torque periodic in time, also where the arm rests",
      .refuted_by = "a period that depends on the motion of the hub, or another phase in each run"};
}

}  // namespace flexarm::effects
