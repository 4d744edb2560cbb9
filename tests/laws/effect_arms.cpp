#include "laws/effect_arms.hpp"

#include "arm/linear_arm.hpp"
#include "effects/registry/vocabulary.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>

namespace flexarm::laws {

namespace {

/// Every effect on the linear arm: their examples move the first poles by a per cent or more, or
/// damp them visibly.
const arm::Effects& every_effect() {
  static const arm::Effects effects = [] {
    arm::Effects made;
    for (const auto& definition : effects::vocabulary()) {
      if (definition->is_of_linear_arm()) made[definition->name] = effects::example(definition);
    }
    return made;
  }();
  return effects;
}

}  // namespace

namespace {

/// A root has one spring: these effects exclude each other.
bool are_compatible(const std::string& first, const std::string& second) {
  const std::set<std::string> root = {"root_compliance", "root_damping"};
  return !(root.contains(first) && root.contains(second));
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
      if (!are_compatible(first->first, second->first)) continue;
      arm::Arm arm = damped_arm();
      arm.effects = {*first, *second};
      arms.push_back({first->first + "_and_" + second->first, arm});
    }
  }
  return arms;
}

EffectArm arm_with_every_effect() {
  arm::Arm arm = damped_arm();
  for (const auto& [name, effect] : every_effect()) {
    const bool fits = std::ranges::all_of(
        arm.effects, [&](const auto& other) { return are_compatible(name, other.first); });
    if (fits) arm.effects[name] = effect;
  }
  return {"every_effect", arm};
}

double agreement_tolerance(const arm::Arm& arm) {
  const arm::LinearArm linear = arm::linear_arm(arm);
  return linear.shear || linear.gravity_m_per_s2 != 0.0 ? 1e-8 : 1e-9;
}

}  // namespace flexarm::laws
