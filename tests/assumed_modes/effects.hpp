#pragma once

#include "arm/arm.hpp"
#include "arms.hpp"
#include "effects/registry/vocabulary.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::assumed_modes::testing_arms {

/// The arm with one more effect.
inline arm::Arm with(arm::Arm arm, const std::string& effect,
                     const std::map<std::string, double>& parameters) {
  effects::put(arm, effect, parameters);
  return arm;
}

inline arm::Arm without_damping(arm::Arm arm) {
  arm.damping = {};
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  const std::vector<std::pair<std::string, std::string>> dampings = {
      {"air_damping", "coefficient"},
      {"drive_compliance", "time"},
      {"root_damping", "time"},
      {"tuned_mass", "damping_ratio"}};
  for (const auto& [name, parameter] : dampings) {
    if (arm.effects.contains(name)) effects::put(arm, name, {{parameter, 0.0}});
  }
  return arm;
}

/// EI = m = l = 1 with a cross-section, so that shear counts: k G A l^2/EI = 3.8 (l/thickness)^2
/// and rho I/(m l^2) = (thickness/l)^2/12.
inline arm::Arm thick_arm(double thickness) {
  constexpr double kWidth = 0.2;
  arm::Arm arm = unit_arm(0.1, 0.5, 0.02);
  arm.beam = {};
  arm.beam.length_m = 1.0;
  arm.beam.width_m = kWidth;
  arm.beam.thickness_m = thickness;
  arm.beam.density_kg_per_m3 = 1.0 / (kWidth * thickness);
  arm.beam.youngs_modulus_Pa = 12.0 / (kWidth * thickness * thickness * thickness);
  arm.beam.shear_modulus_Pa = *arm.beam.youngs_modulus_Pa / 2.6;
  return arm;
}

struct NamedArm {
  std::string name;
  arm::Arm arm;
};

/// One arm for every linear effect that the plain arm has not, and arms with several.
inline std::vector<NamedArm> arms_with_effects() {
  const arm::Arm plain = unit_arm(0.1, 0.5, 0.02);
  std::vector<NamedArm> arms = {
      {"crack near the hub",
       with(plain, "local_stiffness_loss", {{"position", 0.07}, {"stiffness", 1.0}})},
      {"crack near the tip",
       with(plain, "local_stiffness_loss", {{"position", 0.93}, {"stiffness", 1.0}})},
      {"mass", with(plain, "attached_mass", {{"mass", 0.8}, {"position", 0.35}})},
      {"mass near the tip", with(plain, "attached_mass", {{"mass", 0.8}, {"position", 0.96}})},
      {"tuned mass",
       with(plain, "tuned_mass",
            {{"mass", 0.3}, {"frequency", 1.5}, {"damping_ratio", 0.1}, {"position", 0.7}})},
      {"lossy root", with(plain, "root_damping", {{"stiffness", 4.0}, {"time", 0.02}})},
      {"soft drive",
       with(plain, "drive_compliance", {{"stiffness", 6.0}, {"rotor_share", 0.4}, {"time", 0.03}})},
      {"soft root", with(plain, "root_compliance", {{"stiffness", 4.0}})},
      {"hub spring", with(plain, "hub_spring", {{"stiffness", 2.0}})},
      {"hub radius", with(plain, "hub_radius", {{"radius", 0.3}})},
      {"payload offset", with(plain, "payload_offset", {{"offset", -0.15}})},
      {"air", with(plain, "air_damping", {{"coefficient", 0.3}})},
      {"hanging", with(plain, "gravity", {{"acceleration", 4.0}})},
      {"standing", with(plain, "gravity", {{"acceleration", -4.0}})},
      {"shear", with(thick_arm(0.15), "shear_and_rotary_inertia", {})}};
  arm::Arm pair = with(plain, "root_compliance", {{"stiffness", 4.0}});
  pair = with(pair, "local_stiffness_loss", {{"position", 0.4}, {"stiffness", 1.0}});
  arms.push_back({"soft root and crack", pair});
  arm::Arm all = with(thick_arm(0.15), "shear_and_rotary_inertia", {{"shear_coefficient", 0.8}});
  all = with(all, "local_stiffness_loss", {{"position", 0.4}, {"stiffness", 3.0}});
  all = with(all, "root_compliance", {{"stiffness", 10.0}});
  all = with(all, "drive_compliance", {{"stiffness", 8.0}, {"rotor_share", 0.7}, {"time", 0.01}});
  all = with(all, "hub_spring", {{"stiffness", 1.5}});
  all = with(all, "hub_radius", {{"radius", 0.1}});
  all = with(all, "payload_offset", {{"offset", 0.05}});
  all = with(all, "gravity", {{"acceleration", 3.0}});
  all = with(all, "air_damping", {{"coefficient", 0.2}});
  all.damping.kelvin_voigt_s = 2e-4;
  all.hub.viscous_friction_N_m_s_per_rad = 0.05;
  arms.push_back({"everything", all});
  return arms;
}

}  // namespace flexarm::assumed_modes::testing_arms
