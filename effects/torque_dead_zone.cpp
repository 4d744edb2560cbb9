#include "effects/registry/entry.hpp"

namespace flexarm::effects {

namespace {

arm::TorqueStage dead_zone(const arm::Effect& effect) {
  const double width_N_m = effect.value("width");
  if (width_N_m == 0.0) return {arm::torque_order::kDeadZone, arm::PiecewiseLinear()};
  return {arm::torque_order::kDeadZone,
          arm::PiecewiseLinear(1.0, {{-width_N_m, 0.0}, {width_N_m, 0.0}}, 1.0)};
}

}  // namespace

Entry torque_dead_zone() {
  return {
      .definition = define({.name = "torque_dead_zone",
                            .meaning = "T = 0 while abs(tau) <= width, else tau - width sign(tau)",
                            .parameters = {{.name = "width",
                                            .unit = "N m",
                                            .range = arm::kNotNegative,
                                            .meaning = "half-width of the dead zone",
                                            .example = 0.02,
                                            .neutral = 0.0}},
                            .torque_path = dead_zone}),
      .shows = Shows::in_time,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {{"width", 1e-3 * scales.torque_peak_N_m, 0.8 * scales.torque_peak_N_m,
                 Spacing::from_zero}};
      },
      .family = Family::dry_friction,
      .speaks_for = "gain increases with torque amplitude; largest NRMSE in runs of low torque",
      .refuted_by = "gain independent of amplitude"};
}

}  // namespace flexarm::effects
