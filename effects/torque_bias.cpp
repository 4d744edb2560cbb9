#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry torque_bias() {
  return {
      .definition = define({.name = "torque_bias",
                            .meaning = "T = tau + torque",
                            .parameters = {{.name = "torque",
                                            .unit = "N m",
                                            .range = arm::kAnyFinite,
                                            .meaning = "added to the torque that reaches the hub",
                                            .example = 0.004,
                                            .neutral = 0.0}},
                            .hub_torque = [](const arm::Effect& effect) -> arm::HubLaw {
                              return arm::ConstantHubTorque{effect.value("torque")};
                            }}),
      .shows = Shows::in_time,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {{.name = "torque",
                 .lowest = -2.0 * scales.torque_rms_N_m,
                 .highest = 2.0 * scales.torque_rms_N_m,
                 .spacing = Spacing::linear,
                 .neutral = 0.0}};
      },
      .prior = Likely::common,
      .family = Family::constant_torque,
      .speaks_for = "constant residual hub torque; the hub accelerates in one direction",
      .refuted_by = "no motion at zero commanded torque"};
}

}  // namespace flexarm::effects
