#include "arm/rigid_hub.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/uncertainties.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace flexarm::arm {

namespace {

std::string needs_beam(std::string_view what) {
  return fmt::format("{}: needs a beam; the arm file has no [beam]", what);
}

/// An arm on which every effect of a beam shows.
Arm probe_arm() {
  Arm arm = paper_arm();
  arm.beam.shear_modulus_Pa = 2.67e10;
  arm.payload = {0.1, 1e-3};
  arm.hub.viscous_friction_N_m_s_per_rad = 1e-3;
  arm.damping.kelvin_voigt_s = 1e-4;
  return arm;
}

/// Nothing but numbers of the hub differs.
bool differ_in_hub_alone(Arm one, const Arm& other) {
  one.hub = other.hub;
  return one == other;
}

/// Nothing is added but at the hub.
bool are_of_hub_alone(LinearTerms terms) {
  terms.hub_spring_N_m_per_rad = 0.0;
  terms.damping.hub_N_m_s_per_rad = 0.0;
  return terms == LinearTerms{};
}

}  // namespace

bool has_beam(const Arm& arm) {
  return !(arm.beam == Beam{});
}

void require_beam(const Arm& arm, std::string_view what) {
  if (!has_beam(arm)) throw InputError(needs_beam(what), "beam");
}

bool acts_without_beam(const EffectDefinition& definition) {
  if (definition.beam_force || definition.sensor_place) return false;
  if (!definition.arm_number && !definition.linear_term) return true;
  Effect effect{.definition = std::shared_ptr<const EffectDefinition>(
                    std::shared_ptr<const EffectDefinition>(), &definition)};
  for (const auto& parameter : definition.parameters) {
    effect.parameters[parameter.name] = parameter.example;
  }
  const Arm probe = probe_arm();
  Arm changed = probe;
  LinearTerms terms;
  if (definition.arm_number) definition.arm_number(effect, changed);
  if (definition.linear_term) definition.linear_term(effect, changed, terms);
  return differ_in_hub_alone(changed, probe) && are_of_hub_alone(terms);
}

void require_valid_rigid_hub(const Arm& arm) {
  if (!(arm.hub.inertia_kg_m2 > 0.0)) {
    throw out_of_range("hub.inertia", arm.hub.inertia_kg_m2, "kg m^2", "above 0 without a [beam]");
  }
  for (const auto& key : arm_keys()) {
    const auto value = key.get(arm);
    if (!value || key.table == "beam") continue;
    require_in_range(key.name(), *value, key.unit, key.range);
    if (key.table != "hub" && *value != 0.0) {
      const std::string unit = key.unit.empty() ? "" : " " + key.unit;
      throw InputError(needs_beam(fmt::format("{} = {}{}", key.name(), *value, unit)), key.name());
    }
  }
  require_valid(arm.effects);
  for (const auto& [name, effect] : arm.effects) {
    const std::string key = "effects." + name;
    if (!acts_without_beam(*effect.definition)) throw InputError(needs_beam(key), key);
    if (effect.definition->require_fit) {
      effect.definition->require_fit(effect, with_changed_numbers(arm));
    }
    if (!effect.definition->sensor) continue;
    try {
      require_valid(effect.acting_sensor(), arm);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}.sensor: {}", key, error.what()), key + ".sensor");
    }
  }
  require_valid_uncertainties(arm);
}

}  // namespace flexarm::arm
