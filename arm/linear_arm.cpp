#include "arm/linear_arm.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexarm::arm {

namespace {

/// Parameter of an effect, or `otherwise` where the effect or the parameter is not given.
double value_of(const Effects& effects, const std::string& effect, const std::string& parameter,
                double otherwise) {
  const auto found = effects.find(effect);
  if (found == effects.end()) return otherwise;
  const auto value = found->second.parameters.find(parameter);
  return value == found->second.parameters.end() ? otherwise : value->second;
}

double known(const std::optional<double>& value, const char* key, const char* unit) {
  if (value.has_value()) return *value;
  throw InputError(
      fmt::format("{}: missing; effects.shear_and_rotary_inertia needs it [{}]", key, unit), key);
}

ShearAndRotaryInertia shear_of(const Beam& beam, double linear_density_kg_per_m,
                               double shear_coefficient) {
  const double shear_modulus_Pa = known(beam.shear_modulus_Pa, "beam.shear_modulus", "Pa");
  const double width_m = known(beam.width_m, "beam.width", "m");
  const double thickness_m = known(beam.thickness_m, "beam.thickness", "m");
  return {shear_coefficient * shear_modulus_Pa * width_m * thickness_m,
          linear_density_kg_per_m * thickness_m * thickness_m / 12.0};
}

/// Where the beam's springs are: a crack at the root is in series with its compliance.
void place_springs(LinearArm& linear, const Effects& effects) {
  if (effects.contains("root_compliance")) {
    linear.root_stiffness_N_m_per_rad = value_of(effects, "root_compliance", "stiffness", 0.0);
  }
  if (!effects.contains("local_stiffness_loss")) return;
  const double position_m = value_of(effects, "local_stiffness_loss", "position", 0.0);
  const double stiffness = value_of(effects, "local_stiffness_loss", "stiffness", 0.0);
  if (position_m > 0.0) {
    linear.crack = RotationalSpring{position_m, stiffness};
    return;
  }
  const auto& root = linear.root_stiffness_N_m_per_rad;
  linear.root_stiffness_N_m_per_rad =
      root.has_value() ? 1.0 / (1.0 / *root + 1.0 / stiffness) : stiffness;
}

}  // namespace

bool LinearArm::is_plain() const {
  return !shear && !crack && !root_stiffness_N_m_per_rad && air_damping_N_s_per_m2 == 0.0 &&
         hub_radius_m == 0.0 && hub_spring_N_m_per_rad == 0.0 && payload_first_moment_kg_m == 0.0 &&
         gravity_m_per_s2 == 0.0;
}

bool LinearArm::turns_freely() const {
  return hub_spring_N_m_per_rad == 0.0 && gravity_m_per_s2 == 0.0;
}

bool LinearArm::is_damped() const {
  return kelvin_voigt_s > 0.0 || air_damping_N_s_per_m2 > 0.0 ||
         hub_viscous_friction_N_m_s_per_rad > 0.0;
}

LinearArm linear_arm(const Arm& arm) {
  const auto value = [&arm](const char* effect, const char* parameter, double otherwise) {
    return value_of(arm.effects, effect, parameter, otherwise);
  };
  LinearArm linear;
  linear.length_m = arm.beam.length_m;
  linear.flexural_rigidity_N_m2 =
      arm.beam.flexural_rigidity_N_m2() * value("flexural_rigidity", "factor", 1.0);
  linear.linear_density_kg_per_m =
      arm.beam.linear_density_kg_per_m() * value("linear_density", "factor", 1.0);
  linear.thickness_m = arm.beam.thickness_m;
  if (arm.effects.contains("shear_and_rotary_inertia")) {
    constexpr double kRectangle = 5.0 / 6.0;
    linear.shear = shear_of(arm.beam, linear.linear_density_kg_per_m,
                            value("shear_and_rotary_inertia", "shear_coefficient", kRectangle));
  }
  linear.kelvin_voigt_s = arm.damping.kelvin_voigt_s + value("structural_damping", "time", 0.0);
  linear.air_damping_N_s_per_m2 = value("air_damping", "coefficient", 0.0);

  linear.hub_inertia_kg_m2 = arm.hub.inertia_kg_m2 * value("hub_inertia", "factor", 1.0);
  linear.hub_radius_m = value("hub_radius", "radius", 0.0);
  linear.hub_viscous_friction_N_m_s_per_rad =
      arm.hub.viscous_friction_N_m_s_per_rad + value("hub_viscous_friction", "coefficient", 0.0);
  linear.hub_spring_N_m_per_rad = value("hub_spring", "stiffness", 0.0);
  place_springs(linear, arm.effects);

  const double offset_m = value("payload_offset", "offset", 0.0);
  const double mass_kg = arm.payload.mass_kg + value("payload_mass", "mass", 0.0);
  linear.payload_mass_kg = mass_kg;
  linear.payload_first_moment_kg_m = mass_kg * offset_m;
  linear.payload_tip_inertia_kg_m2 = arm.payload.inertia_kg_m2 +
                                     value("payload_inertia", "inertia", 0.0) +
                                     mass_kg * offset_m * offset_m;
  linear.gravity_m_per_s2 = value("gravity", "acceleration", 0.0);
  return linear;
}

const std::vector<std::string_view>& linear_effect_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> linear;
    for (const auto& definition : effect_vocabulary()) {
      if (definition.place == EffectPlace::linear_arm) linear.emplace_back(definition.name);
    }
    return linear;
  }();
  return names;
}

double total_inertia_kg_m2(const LinearArm& arm) {
  const double l = arm.length_m;
  const double a = arm.hub_radius_m;
  const double reach = a + l;
  const double beam = arm.linear_density_kg_per_m * l * (a * reach + l * l / 3.0) +
                      (arm.shear ? arm.shear->rotary_inertia_kg_m * l : 0.0);
  return arm.hub_inertia_kg_m2 + beam + arm.payload_mass_kg * reach * reach +
         2.0 * arm.payload_first_moment_kg_m * reach + arm.payload_tip_inertia_kg_m2;
}

double omega_scale_rad_per_s(const LinearArm& arm) {
  return std::sqrt(arm.flexural_rigidity_N_m2 / arm.linear_density_kg_per_m) /
         (arm.length_m * arm.length_m);
}

}  // namespace flexarm::arm
