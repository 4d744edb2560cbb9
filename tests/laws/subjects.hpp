#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "response/any_formulation.hpp"

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace flexarm::laws {

inline constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle};
inline constexpr arm::Sensor kHubVelocity{arm::SensorKind::hub_velocity};
inline constexpr arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration};

/// A formulation at one setting, and how exact its laws may be expected to hold.
struct Subject {
  std::string name;
  std::function<response::AnyFormulation(const arm::Arm&)> make;
  /// Relative error of the first five poles and hub zeros of this setting: rounding for exact_tf,
  /// discretisation (order of the method) for the others.
  double root_tolerance;
};

inline void PrintTo(const Subject& subject, std::ostream* out) {
  *out << subject.name;
}

/// Every formulation, fem and assumed_modes at more than one setting.
std::vector<Subject> every_formulation();

/// Arms that differ in every parameter: bare, with payload mass, payload inertia, heavy hub.
std::vector<arm::Arm> varied_arms();

/// A beam of unit length, rigidity and linear density with a hub inertia.
arm::Arm unit_arm(double hub_inertia_kg_m2);

}  // namespace flexarm::laws
