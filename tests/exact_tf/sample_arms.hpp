#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"

#include <ostream>
#include <string>
#include <vector>

namespace flexarm::arm {

/// How GoogleTest shows an arm.
inline void PrintTo(const Arm& arm, std::ostream* out) {
  *out << arm.name;
}

}  // namespace flexarm::arm

namespace flexarm::exact_tf {

/// The project's figure; references have 25 digits or more.
inline constexpr double kRelativeTolerance = 1e-13;

inline constexpr arm::Sensor kHub{arm::SensorKind::hub_angle};
inline constexpr arm::Sensor kTip{arm::SensorKind::tip_acceleration};

/// A beam with EI = m = l = 1 and 2 m thickness, so that ratios are values and strain is curvature.
inline arm::Arm unit_arm(double hub_inertia, double payload_mass, double payload_inertia,
                         double kelvin_voigt_s = 0.0, double friction = 0.0) {
  arm::Arm arm;
  arm.name = "hub inertia " + std::to_string(hub_inertia) + ", payload mass " +
             std::to_string(payload_mass) + ", payload inertia " + std::to_string(payload_inertia);
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.beam.thickness_m = 2.0;
  arm.hub = {hub_inertia, friction};
  arm.payload = {payload_mass, payload_inertia};
  arm.damping.kelvin_voigt_s = kelvin_voigt_s;
  return arm;
}

/// The corners and the middle of the ranges that exact_tf is meant for.
inline std::vector<arm::Arm> undamped_arms() {
  std::vector<arm::Arm> arms = {arm::paper_arm(), unit_arm(0.1, 0.5, 0.02)};
  for (const double hub_inertia : {0.0, 1e6}) {
    for (const double payload_mass : {0.0, 1e3}) {
      for (const double payload_inertia : {0.0, 1e2}) {
        arms.push_back(unit_arm(hub_inertia, payload_mass, payload_inertia));
      }
    }
  }
  return arms;
}

}  // namespace flexarm::exact_tf
