#pragma once

#include "arm/arm.hpp"
#include "compare/comparison.hpp"

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::compare {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline const arm::Sensor kHubAngle{arm::SensorKind::hub_angle, 0.0};
inline const arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration, 0.0};

/// A beam of unit length, rigidity and linear density: hub and payload are given as their ratios.
inline arm::Arm unit_arm(double hub_inertia, arm::Payload payload) {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.hub.inertia_kg_m2 = hub_inertia;
  arm.payload = payload;
  return arm;
}

/// The paper's arm bare; with payload mass; with payload inertia too; and with both dampings.
inline std::vector<std::pair<std::string, arm::Arm>> varied_arms() {
  std::vector<std::pair<std::string, arm::Arm>> arms(4, {"bare", arm::paper_arm()});
  arms[1].first = "payload mass";
  arms[1].second.payload = {0.06, 0.0};
  arms[2].first = "payload mass and inertia";
  arms[2].second.payload = {0.2, 1e-3};
  arms[3].first = "payload and damping";
  arms[3].second.payload = {0.06, 2e-5};
  arms[3].second.damping.kelvin_voigt_s = 1.2e-4;
  arms[3].second.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  return arms;
}

/// No refinement series.
inline Options quick() {
  Options options;
  options.refinements = false;
  return options;
}

}  // namespace flexarm::compare
