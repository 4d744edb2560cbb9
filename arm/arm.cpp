#include "arm/arm.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "arm/sensor.hpp"
#include "arm/uncertainties.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexarm::arm {

namespace {

double beam_inertia_kg_m2(const LinearArm& arm) {
  return arm.linear_density_kg_per_m * std::pow(arm.length_m, 3);
}

/// What the effects say about places must fit the beam, as they have it.
void require_on_beam(const Arm& arm) {
  const Arm changed = with_changed_numbers(arm);
  for (const auto& [name, effect] : arm.effects) {
    if (effect.definition->require_fit) effect.definition->require_fit(effect, changed);
    if (!effect.definition->sensor) continue;
    const std::string key = fmt::format("effects.{}.sensor", name);
    try {
      require_valid(effect.acting_sensor(), arm);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", key, error.what()), key);
    }
  }
}

}  // namespace

void require_valid(const Arm& arm) {
  if (!has_beam(arm)) {
    require_valid_rigid_hub(arm);
    return;
  }
  require_valid(arm.beam);
  for (const auto& table : arm_tables()) require_in_range(arm, table);
  require_valid(arm.effects);
  require_on_beam(arm);
  require_valid_uncertainties(arm);
}

Arm without_hypotheses(const Arm& arm) {
  Arm made = arm;
  for (const auto& [name, hypothesis] : arm.hypotheses) made.effects.erase(name);
  return made;
}

double total_inertia_kg_m2(const Arm& arm) {
  return total_inertia_kg_m2(linear_arm(arm));
}

double omega_scale_rad_per_s(const Arm& arm) {
  return omega_scale_rad_per_s(linear_arm(arm));
}

double hub_inertia_ratio(const Arm& arm) {
  const LinearArm linear = linear_arm(arm);
  return linear.hub_inertia_kg_m2 / beam_inertia_kg_m2(linear);
}

double payload_mass_ratio(const Arm& arm) {
  const LinearArm linear = linear_arm(arm);
  return linear.payload_mass_kg / (linear.linear_density_kg_per_m * linear.length_m);
}

double payload_inertia_ratio(const Arm& arm) {
  const LinearArm linear = linear_arm(arm);
  return linear.payload_tip_inertia_kg_m2 / beam_inertia_kg_m2(linear);
}

Arm paper_arm() {
  Arm arm;
  arm.name = "aluminium link of the paper's Table 1";
  arm.beam = Beam::from_section(0.960, 0.019008, 0.0032004, 2710.0, 7.11e10);
  // E times the area moment as Table 1 rounds it; the section alone gives 3.6917949 N m^2.
  arm.beam.given_flexural_rigidity_N_m2 = 3.6917964;
  arm.hub.inertia_kg_m2 = 5.86e-4;
  return arm;
}

}  // namespace flexarm::arm
