#include "effects/registry/entry.hpp"

#include <algorithm>
#include <limits>

namespace flexarm::effects {

Entry torque_saturation() {
  return {.definition =
              define({.name = "torque_saturation",
                      .meaning = "T = tau limited to +-limit",
                      .parameters = {{.name = "limit",
                                      .unit = "N m",
                                      .range = arm::kPositive,
                                      .meaning = "largest magnitude of the torque",
                                      .example = 0.09,
                                      .neutral = std::numeric_limits<double>::infinity()}},
                      .torque_path =
                          [](const arm::Effect& effect) {
                            const double limit_N_m = effect.value("limit");
                            return arm::TorqueStage{
                                arm::torque_order::kSaturation,
                                arm::PiecewiseLinear(
                                    0.0, {{-limit_N_m, -limit_N_m}, {limit_N_m, limit_N_m}}, 0.0)};
                          }}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            // A limit below nearly all of the torque would be a gain.
            return {{.name = "limit",
                     .lowest = std::max(0.03 * scales.torque_peak_N_m, scales.torque_low_N_m),
                     .highest = scales.torque_peak_N_m,
                     .neutral = scales.torque_peak_N_m}};
          },
          .applies =
              [](const Scales& scales) { return scales.torque_low_N_m < scales.torque_peak_N_m; },
          .family = Family::torque_scale,
          .speaks_for = "excess residual only where the torque magnitude is large",
          .refuted_by = "excess residual at low torque"};
}

}  // namespace flexarm::effects
