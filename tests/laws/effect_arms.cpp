#include "laws/effect_arms.hpp"

#include "arm/linear_arm.hpp"

#include <cstddef>
#include <map>

namespace flexarm::laws {

namespace {

/// Sizes that move the first poles by a per cent or more, or damp them visibly.
const arm::Effects& every_effect() {
  const auto effect = [](std::map<std::string, double> parameters) {
    return arm::Effect{std::move(parameters), ""};
  };
  static const arm::Effects effects = {
      {"hub_inertia", effect({{"factor", 1.4}})},
      {"flexural_rigidity", effect({{"factor", 0.85}})},
      {"linear_density", effect({{"factor", 1.15}})},
      {"payload_mass", effect({{"mass", 0.03}})},
      {"payload_inertia", effect({{"inertia", 3e-4}})},
      {"payload_offset", effect({{"offset", 0.04}})},
      {"hub_radius", effect({{"radius", 0.05}})},
      {"root_compliance", effect({{"stiffness", 30.0}})},
      {"local_stiffness_loss", effect({{"position", 0.31}, {"stiffness", 15.0}})},
      {"hub_spring", effect({{"stiffness", 0.6}})},
      {"gravity", effect({{"acceleration", 9.81}})},
      {"shear_and_rotary_inertia", effect({})},
      {"hub_viscous_friction", effect({{"coefficient", 0.01}})},
      {"structural_damping", effect({{"time", 2e-4}})},
      {"air_damping", effect({{"coefficient", 0.05}})},
  };
  return effects;
}

}  // namespace

arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.beam.shear_modulus_Pa = 2.67e10;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  arm.payload = {0.05, 1e-4};
  arm.damping.kelvin_voigt_s = 1.2e-4;
  return arm;
}

std::vector<EffectArm> arms_with_one_effect() {
  std::vector<EffectArm> arms;
  for (const auto& [name, effect] : every_effect()) {
    arm::Arm arm = damped_arm();
    arm.effects[name] = effect;
    arms.push_back({name, arm});
  }
  return arms;
}

std::vector<EffectArm> arms_with_two_effects() {
  std::vector<EffectArm> arms;
  for (auto first = every_effect().begin(); first != every_effect().end(); ++first) {
    for (auto second = std::next(first); second != every_effect().end(); ++second) {
      arm::Arm arm = damped_arm();
      arm.effects = {*first, *second};
      arms.push_back({first->first + "_and_" + second->first, arm});
    }
  }
  return arms;
}

EffectArm arm_with_every_effect() {
  arm::Arm arm = damped_arm();
  arm.effects = every_effect();
  return {"every_effect", arm};
}

double agreement_tolerance(const arm::Arm& arm) {
  const arm::LinearArm linear = arm::linear_arm(arm);
  return linear.shear || linear.gravity_m_per_s2 != 0.0 ? 1e-8 : 1e-9;
}

}  // namespace flexarm::laws
