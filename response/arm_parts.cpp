#include "response/arm_parts.hpp"

#include "arm/effects.hpp"

#include <cmath>

namespace flexarm::response {

namespace {

bool is_linear_actuator(const std::string& name) {
  return name == "torque_gain" || name == "torque_bias" || name == "actuator_lag" ||
         name == "time_delay";
}

void add(ArmParts& parts, const std::string& name, const arm::Effect& effect) {
  const auto value = [&effect](const char* parameter) { return effect.parameters.at(parameter); };
  if (name == "quadratic_drag") parts.quadratic_drag_N_s2_per_m3 = value("coefficient");
  if (name == "coulomb_friction") parts.friction.coulomb_N_m = value("torque");
  if (name == "stribeck_friction") {
    parts.friction.stribeck_N_m = value("torque");
    parts.friction.stribeck_static_N_m = value("static_torque");
    parts.friction.stribeck_velocity_rad_per_s = value("velocity");
  }
  if (name == "torque_gain") parts.actuator.gain = value("factor");
  if (name == "torque_bias") parts.actuator.bias_N_m = value("torque");
  if (name == "torque_saturation") parts.actuator.saturation_N_m = value("limit");
  if (name == "torque_dead_zone") parts.actuator.dead_zone_N_m = value("width");
  if (name == "torque_ripple") {
    parts.actuator.ripple = TorqueRipple{value("amplitude"), value("cycles"), value("phase")};
  }
  if (name == "actuator_lag") parts.actuator.lag_s = value("time_constant");
  if (name == "time_delay") parts.actuator.delay_s = value("delay");
  if (name == "sensor_lag") {
    parts.sensor_lag =
        SensorLag{effect.sensor.empty() ? arm::Sensor{arm::SensorKind::tip_acceleration, 0.0}
                                        : arm::parse_sensor(effect.sensor),
                  value("time_constant")};
  }
}

}  // namespace

bool HubFriction::is_zero() const {
  return coulomb_N_m == 0.0 && stribeck_N_m == 0.0 && stribeck_static_N_m == 0.0;
}

double HubFriction::torque_N_m(double hub_velocity_rad_per_s) const {
  const double relative = hub_velocity_rad_per_s / stribeck_velocity_rad_per_s;
  return coulomb_N_m + stribeck_N_m +
         (stribeck_static_N_m - stribeck_N_m) * std::exp(-relative * relative);
}

double HubFriction::breakaway_N_m() const {
  return coulomb_N_m + stribeck_static_N_m;
}

ArmParts take_apart(const arm::Arm& arm) {
  arm::require_valid(arm);
  ArmParts parts;
  parts.linear = arm;
  std::erase_if(parts.linear.effects, [](const auto& effect) {
    return arm::find_effect(effect.first)->place != arm::EffectPlace::linear_arm;
  });
  for (const auto& [name, effect] : arm.effects) {
    if (!parts.linear.effects.contains(name)) add(parts, name, effect);
  }
  return parts;
}

std::vector<std::string> nonlinear_effects(const arm::Arm& arm) {
  std::vector<std::string> names;
  for (const auto& definition : arm::effect_vocabulary()) {
    const bool nonlinear =
        definition.place == arm::EffectPlace::nonlinear_arm ||
        (definition.place == arm::EffectPlace::actuator && !is_linear_actuator(definition.name));
    if (nonlinear && arm.effects.contains(definition.name)) names.push_back(definition.name);
  }
  return names;
}

}  // namespace flexarm::response
