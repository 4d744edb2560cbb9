#include "arm/effects.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace flexarm::arm {

namespace {

EffectParameter positive(const char* name, const char* unit) {
  return {name, unit, kPositive, true};
}
EffectParameter not_negative(const char* name, const char* unit) {
  return {name, unit, kNotNegative, true};
}
EffectParameter any(const char* name, const char* unit) {
  return {name, unit, kAnyFinite, true};
}
EffectParameter optional_positive(const char* name, const char* unit) {
  return {name, unit, kPositive, false};
}

std::vector<std::string> names_of(const std::vector<EffectParameter>& parameters) {
  std::vector<std::string> names;
  for (const auto& parameter : parameters) names.push_back(parameter.name);
  return names;
}

void require_valid(const std::string& key, const EffectDefinition& definition,
                   const Effect& effect) {
  if (!effect.sensor.empty() && !definition.acts_on_sensor) {
    throw InputError(fmt::format("{}.sensor: unknown key; only sensor_lag acts on one sensor", key),
                     key + ".sensor");
  }
  for (const auto& [name, value] : effect.parameters) {
    const auto parameter = std::ranges::find(definition.parameters, name, &EffectParameter::name);
    if (parameter == definition.parameters.end()) {
      auto names = names_of(definition.parameters);
      if (definition.acts_on_sensor) names.emplace_back("sensor");
      throw InputError(fmt::format("{}.{}: unknown key{}; allowed: {}", key, name,
                                   did_you_mean(name, names), fmt::join(names, ", ")),
                       key + "." + name);
    }
    require_in_range(key + "." + name, value, parameter->unit, parameter->range);
  }
  for (const auto& parameter : definition.parameters) {
    if (parameter.required && !effect.parameters.contains(parameter.name)) {
      throw InputError(fmt::format("{}.{}: missing; must be {} [{}]", key, parameter.name,
                                   to_string(parameter.range), parameter.unit),
                       key + "." + parameter.name);
    }
  }
}

}  // namespace

const std::vector<EffectDefinition>& effect_vocabulary() {
  static const std::vector<EffectDefinition> vocabulary = {
      {"hub_inertia",
       EffectPlace::linear_arm,
       {positive("factor", "1")},
       "hub inertia is factor times the arm file's"},
      {"flexural_rigidity",
       EffectPlace::linear_arm,
       {positive("factor", "1")},
       "EI is factor times the arm file's"},
      {"linear_density",
       EffectPlace::linear_arm,
       {positive("factor", "1")},
       "mass per length is factor times the arm file's"},
      {"payload_mass",
       EffectPlace::linear_arm,
       {not_negative("mass", "kg")},
       "a further mass at the tip, payload or none"},
      {"payload_inertia",
       EffectPlace::linear_arm,
       {not_negative("inertia", "kg m^2")},
       "a further rotary inertia at the tip"},
      {"payload_offset",
       EffectPlace::linear_arm,
       {any("offset", "m")},
       "the payload's centre of mass lies this far beyond the tip"},
      {"hub_radius",
       EffectPlace::linear_arm,
       {not_negative("radius", "m")},
       "the beam starts at this distance from the axis: y(0) = radius theta"},
      {"root_compliance",
       EffectPlace::linear_arm,
       {positive("stiffness", "N m/rad")},
       "a rotational spring between hub and beam root"},
      {"local_stiffness_loss",
       EffectPlace::linear_arm,
       {not_negative("position", "m"), positive("stiffness", "N m/rad")},
       "a crack: a massless rotational spring in the beam at this place"},
      {"hub_spring",
       EffectPlace::linear_arm,
       {not_negative("stiffness", "N m/rad")},
       "a spring from the hub to ground (a cable)"},
      {"gravity",
       EffectPlace::linear_arm,
       {any("acceleration", "m/s^2")},
       "the arm hangs along gravity, its beam under tension; negative stands up"},
      {"shear_and_rotary_inertia",
       EffectPlace::linear_arm,
       {optional_positive("shear_coefficient", "1")},
       "Timoshenko beam instead of Euler-Bernoulli"},
      {"hub_viscous_friction",
       EffectPlace::linear_arm,
       {not_negative("coefficient", "N m s/rad")},
       "further torque -coefficient theta' at the hub"},
      {"structural_damping",
       EffectPlace::linear_arm,
       {not_negative("time", "s")},
       "further Kelvin-Voigt time"},
      {"air_damping",
       EffectPlace::linear_arm,
       {not_negative("coefficient", "N s/m^2")},
       "force per length -coefficient dy/dt"},
      {"quadratic_drag",
       EffectPlace::nonlinear_arm,
       {not_negative("coefficient", "N s^2/m^3")},
       "force per length -coefficient abs(v) v, v = dy/dt"},
      {"coulomb_friction",
       EffectPlace::nonlinear_arm,
       {not_negative("torque", "N m")},
       "hub friction of constant size against the motion; holds the hub at rest below it"},
      {"stribeck_friction",
       EffectPlace::nonlinear_arm,
       {not_negative("torque", "N m"), not_negative("static_torque", "N m"),
        positive("velocity", "rad/s")},
       "hub friction that falls from static_torque to torque as the hub speeds up"},
      {"torque_gain",
       EffectPlace::actuator,
       {any("factor", "1")},
       "the torque that reaches the hub is factor times the commanded one"},
      {"torque_bias", EffectPlace::actuator, {any("torque", "N m")}, "a constant torque is added"},
      {"torque_saturation",
       EffectPlace::actuator,
       {positive("limit", "N m")},
       "the torque is clipped to +-limit"},
      {"torque_dead_zone",
       EffectPlace::actuator,
       {not_negative("width", "N m")},
       "no torque while the command is within +-width, less by width beyond"},
      {"torque_ripple",
       EffectPlace::actuator,
       {any("amplitude", "N m"), positive("cycles", "1/rev"), any("phase", "rad")},
       "torque amplitude sin(cycles theta + phase) is added"},
      {"actuator_lag",
       EffectPlace::actuator,
       {not_negative("time_constant", "s")},
       "the torque follows its command through 1 / (1 + time_constant s)"},
      {"time_delay",
       EffectPlace::actuator,
       {not_negative("delay", "s")},
       "the torque follows its command after the delay"},
      {"sensor_lag",
       EffectPlace::sensor,
       {not_negative("time_constant", "s")},
       "one sensor, tip_acceleration unless named, reads through 1 / (1 + time_constant s)",
       true},
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
                                   did_you_mean(name, names), fmt::join(names, ", ")),
                       "effects." + name);
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
                                       : fmt::format("it honours {}", fmt::join(honoured, ", "))),
          "effects." + name);
    }
  }
}

}  // namespace flexarm::arm
