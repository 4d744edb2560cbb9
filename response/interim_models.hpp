#pragma once
// INTERIM, to be removed
#include "arm/linear_arm.hpp"
#include "response/any_formulation.hpp"

namespace flexarm::response {
inline arm::ModalModel plain_modal_model(const AnyFormulation& f, int count,
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

inline arm::DampedPoleSet plain_damped_poles(const AnyFormulation& f, int count) {
  arm::DampedPoleSet set;
  const auto model = plain_modal_model(f, count, {}, {});
  const std::size_t n = model.modes.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double w = model.modes[i].omega_rad_per_s;
    const double d = model.damping_rad_per_s[i * n + i] / 2;
    arm::PolePair p;
    if (w > d) {
      p = {{-d, std::sqrt(w * w - d * d)}, {-d, -std::sqrt(w * w - d * d)}};
    } else {
      const double r = std::sqrt(d * d - w * w);
      p = {{-d + r, 0.0}, {-d - r, 0.0}};
    }
    (i == 0 ? set.lowest : set.flexible.emplace_back()) = p;
  }
  return set;
}
inline arm::ModalModel modal_model(const AnyFormulation& any, int count,
                                   std::span<const arm::Sensor> sensors,
                                   std::span<const double> stations_m) {
  return std::visit(
      [&](const auto& f) {
        if constexpr (requires { f.modal_model(count, sensors, stations_m); })
          return f.modal_model(count, sensors, stations_m);
        else
          return plain_modal_model(any, count, sensors, stations_m);
      },
      any);
}
inline arm::DampedPoleSet damped_poles(const AnyFormulation& any, int count) {
  return std::visit(
      [&](const auto& f) {
        if constexpr (requires { f.damped_poles(count); })
          return f.damped_poles(count);
        else
          return plain_damped_poles(any, count);
      },
      any);
}
}  // namespace flexarm::response
