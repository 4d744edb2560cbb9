#pragma once

#include "response/formulation_maker.hpp"
#include "response/frequency/response_study.hpp"

namespace flexarm::report {

/// An arm with an actuator, a sensor that lags, and friction that a linear response leaves out.
inline arm::Arm sample_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  arm.effects["coulomb_friction"].parameters["torque"] = 0.01;
  arm.effects["time_delay"].parameters["delay"] = 1e-3;
  arm.effects["actuator_lag"].parameters["time_constant"] = 2e-3;
  arm.effects["torque_gain"].parameters["factor"] = 1.5;
  arm.effects["sensor_lag"].parameters["time_constant"] = 1e-3;
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
