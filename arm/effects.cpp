#include "arm/effects.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::arm {

namespace {

constexpr double kAny = -std::numeric_limits<double>::infinity();

EffectParameter positive(const char* name, const char* unit) {
  return {name, unit, 0.0, true, true};
}
EffectParameter not_negative(const char* name, const char* unit) {
  return {name, unit, 0.0, false, true};
}
EffectParameter any(const char* name, const char* unit) {
  return {name, unit, kAny, false, true};
}
EffectParameter optional_positive(const char* name, const char* unit) {
  return {name, unit, 0.0, true, false};
}

std::vector<std::string> names_of(const std::vector<EffectParameter>& parameters) {
  std::vector<std::string> names;
  for (const auto& parameter : parameters) names.push_back(parameter.name);
  return names;
}

void require_valid(const std::string& key, const EffectDefinition& definition,
                   const Effect& effect) {
  for (const auto& [name, value] : effect.parameters) {
    const auto parameter = std::ranges::find(definition.parameters, name, &EffectParameter::name);
    if (parameter == definition.parameters.end()) {
      const auto names = names_of(definition.parameters);
      throw InputError(fmt::format("{}.{}: unknown key{}; allowed: {}", key, name,
                                   did_you_mean(name, names), fmt::join(names, ", ")));
    }
    const bool inside =
        parameter->exclusive_minimum ? value > parameter->minimum : value >= parameter->minimum;
    if (!std::isfinite(value) || !inside) {
      const std::string allowed =
          parameter->minimum == kAny ? "a finite number"
          : parameter->exclusive_minimum
              ? fmt::format("a finite number above {}", parameter->minimum)
              : fmt::format("a finite number, {} or more", parameter->minimum);
      throw out_of_range(key + "." + name, value, parameter->unit, allowed);
    }
  }
  for (const auto& parameter : definition.parameters) {
    if (parameter.required && !effect.parameters.contains(parameter.name)) {
      throw InputError(
          fmt::format("{}.{}: missing; a number [{}]", key, parameter.name, parameter.unit));
    }
  }
  if (!effect.sensor.empty() && definition.name != "sensor_lag") {
    throw InputError(
        fmt::format("{}.sensor: unknown key; only sensor_lag acts on one sensor", key));
  }
}

}  // namespace

const std::vector<EffectDefinition>& effect_vocabulary() {
  static const std::vector<EffectDefinition> vocabulary = {
      {"hub_inertia", {positive("factor", "1")}},
      {"flexural_rigidity", {positive("factor", "1")}},
      {"linear_density", {positive("factor", "1")}},
      {"payload_mass", {not_negative("mass", "kg")}},
      {"payload_inertia", {not_negative("inertia", "kg m^2")}},
      {"payload_offset", {any("offset", "m")}},
      {"hub_radius", {not_negative("radius", "m")}},
      {"root_compliance", {positive("stiffness", "N m/rad")}},
      {"local_stiffness_loss", {not_negative("position", "m"), positive("stiffness", "N m/rad")}},
      {"hub_spring", {not_negative("stiffness", "N m/rad")}},
      {"gravity", {any("acceleration", "m/s^2")}},
      {"shear_and_rotary_inertia", {optional_positive("shear_coefficient", "1")}},
      {"hub_viscous_friction", {not_negative("coefficient", "N m s/rad")}},
      {"structural_damping", {not_negative("time", "s")}},
      {"air_damping", {not_negative("coefficient", "N s/m^2")}},
      {"quadratic_drag", {not_negative("coefficient", "N s^2/m^3")}},
      {"coulomb_friction", {not_negative("torque", "N m")}},
      {"stribeck_friction",
       {not_negative("torque", "N m"), not_negative("static_torque", "N m"),
        positive("velocity", "rad/s")}},
      {"torque_gain", {any("factor", "1")}},
      {"torque_bias", {any("torque", "N m")}},
      {"torque_saturation", {positive("limit", "N m")}},
      {"torque_dead_zone", {not_negative("width", "N m")}},
      {"torque_ripple",
       {any("amplitude", "N m"), positive("cycles", "1/rev"), any("phase", "rad")}},
      {"actuator_lag", {not_negative("time_constant", "s")}},
      {"time_delay", {not_negative("delay", "s")}},
      {"sensor_lag", {not_negative("time_constant", "s")}},
  };
  return vocabulary;
}

const EffectDefinition* find_effect(std::string_view name) {
  const auto& vocabulary = effect_vocabulary();
  const auto entry = std::ranges::find(vocabulary, name, &EffectDefinition::name);
  return entry == vocabulary.end() ? nullptr : &*entry;
}

void require_valid(const Effects& effects) {
  for (const auto& [name, effect] : effects) {
    const EffectDefinition* definition = find_effect(name);
    if (definition == nullptr) {
      std::vector<std::string> names;
      for (const auto& entry : effect_vocabulary()) names.push_back(entry.name);
      throw InputError(fmt::format("effects.{}: unknown effect{}; allowed: {}", name,
                                   did_you_mean(name, names), fmt::join(names, ", ")));
    }
    require_valid("effects." + name, *definition, effect);
  }
}

void require_honoured(const Effects& effects, std::string_view formulation,
                      const std::vector<std::string_view>& honoured) {
  for (const auto& [name, effect] : effects) {
    if (std::ranges::find(honoured, name) == honoured.end()) {
      throw InputError(
          fmt::format("effects.{}: {} does not honour this effect; {}", name, formulation,
                      honoured.empty() ? std::string("it honours none yet")
                                       : fmt::format("it honours {}", fmt::join(honoured, ", "))));
    }
  }
}

}  // namespace flexarm::arm
