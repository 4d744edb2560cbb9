#pragma once

#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/response_study.hpp"

namespace flexarm::report {

/// An arm with an actuator, sensors that lag, are late and wrongly scaled, and friction that a
/// linear response leaves out.
inline arm::Arm sample_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  effects::put(arm, "coulomb_friction", {{"torque", 0.01}});
  effects::put(arm, "time_delay", {{"delay", 1e-3}});
  effects::put(arm, "actuator_lag", {{"time_constant", 2e-3}});
  effects::put(arm, "torque_gain", {{"factor", 1.5}});
  effects::put(arm, "sensor_lag", {{"time_constant", 1e-3}});
  effects::put(arm, "sensor_delay", {{"delay", 4e-3}});
  effects::put(arm, "sensor_gain", {{"factor", 0.9}}, "hub_angle");
  return arm;
}

inline response::ResponseStudy sample_study(const arm::Arm& arm = sample_arm()) {
  response::ResponseOptions options;
  options.sensors = {{arm::SensorKind::hub_angle}, {arm::SensorKind::tip_acceleration}};
  options.modes = 3;
  options.points = 60;
  options.state_space = true;
  return response::study_response(arm, response::make_formulation("exact_tf", arm, 4), options);
}

}  // namespace flexarm::report
