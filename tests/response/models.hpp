#pragma once

#include "arm/linear_arm.hpp"
#include "response/any_formulation.hpp"
#include "response/formulation_maker.hpp"

#include <vector>

namespace flexarm::response {

inline constexpr const char* kFormulations[] = {"exact_tf", "fem", "assumed_modes"};

inline const std::vector<arm::Sensor>& every_sensor() {
  static const std::vector<arm::Sensor> sensors = {
      {arm::SensorKind::hub_angle},        {arm::SensorKind::hub_velocity},
      {arm::SensorKind::tip_acceleration}, {arm::SensorKind::tip_displacement},
      {arm::SensorKind::tip_deflection},   {arm::SensorKind::strain, 0.05}};
  return sensors;
}

/// The paper's arm with a payload, Kelvin-Voigt damping and hub friction.
inline arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.payload.mass_kg = 0.03;
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  return arm;
}

/// INTERIM: of the plain arm.
inline arm::ModalModel modal_model(const AnyFormulation& f, int count,
                                   std::span<const arm::Sensor> sensors,
                                   std::span<const double> stations_m) {
  arm::ModalModel model;
  const auto lin = arm::linear_arm(arm_of(f));
  model.modal_mass_kg_m2 = arm::total_inertia_kg_m2(lin);
  arm::Mode rigid;
  rigid.hub_slope = 1.0;
  for (auto& s : sensors) {
    rigid.sensor_values.push_back(arm::is_collocated(s) ? 1.0
                                  : s.kind == arm::SensorKind::tip_acceleration ||
                                          s.kind == arm::SensorKind::tip_displacement
                                      ? lin.length_m
                                      : 0.0);
  }
  for (double x : stations_m) rigid.displacement_m.push_back(x);
  model.modes.push_back(rigid);
  for (auto& m : modes(f, count, sensors, stations_m)) model.modes.push_back(m);
  const auto n = model.modes.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const auto& a = model.modes[i];
      const auto& b = model.modes[j];
      model.damping_rad_per_s.push_back(
          lin.hub_viscous_friction_N_m_s_per_rad * a.hub_slope * b.hub_slope /
              model.modal_mass_kg_m2 +
          (i == j ? lin.kelvin_voigt_s * a.omega_rad_per_s * a.omega_rad_per_s : 0.0));
    }
  }
  return model;
}

}  // namespace flexarm::response
