#include "arm/arm_keys.hpp"

#include "arm/input_error.hpp"

namespace flexarm::arm {

namespace {

constexpr bool kRequired = true;
constexpr bool kMayBeAbsent = false;

/// A row whose value is the member `Member` of the part `Part` of an arm.
template <auto Part, auto Member>
ArmKey row(const char* table, const char* leaf, const char* symbol, const char* unit, Range range,
           bool required, const char* meaning) {
  return {.table = table,
          .leaf = leaf,
          .symbol = symbol,
          .unit = unit,
          .range = range,
          .required = required,
          .meaning = meaning,
          .get = [](const Arm& arm) -> std::optional<double> { return arm.*Part.*Member; },
          .set = [](Arm& arm, double value) { arm.*Part.*Member = value; }};
}

template <auto Member>
constexpr auto beam = row<&Arm::beam, Member>;
template <auto Member>
constexpr auto hub = row<&Arm::hub, Member>;
template <auto Member>
constexpr auto payload = row<&Arm::payload, Member>;
template <auto Member>
constexpr auto damping = row<&Arm::damping, Member>;

}  // namespace

const std::vector<ArmKey>& arm_keys() {
  static const std::vector<ArmKey> keys = {
      beam<&Beam::length_m>("beam", "length", "l", "m", kPositive, kRequired,
                            "from the motor axis, or the end of the hub radius, to the tip"),
      beam<&Beam::width_m>("beam", "width", "w", "m", kPositive, kMayBeAbsent,
                           "out of the bending plane"),
      beam<&Beam::thickness_m>("beam", "thickness", "t", "m", kPositive, kMayBeAbsent,
                               "in the bending plane; strain sensors need it"),
      beam<&Beam::density_kg_per_m3>("beam", "density", "rho", "kg/m^3", kPositive, kMayBeAbsent,
                                     "of the material"),
      beam<&Beam::youngs_modulus_Pa>("beam", "youngs_modulus", "E", "Pa", kPositive, kMayBeAbsent,
                                     "of the material"),
      beam<&Beam::shear_modulus_Pa>("beam", "shear_modulus", "G", "Pa", kPositive, kMayBeAbsent,
                                    "only effects.shear_and_rotary_inertia needs it"),
      beam<&Beam::given_flexural_rigidity_N_m2>(
          "beam", "flexural_rigidity", "EI", "N m^2", kPositive, kMayBeAbsent,
          "alternative to youngs_modulus; if both, equal to E w t^3/12"),
      beam<&Beam::given_linear_density_kg_per_m>(
          "beam", "linear_density", "m", "kg/m", kPositive, kMayBeAbsent,
          "alternative to density; if both, equal to rho w t"),
      hub<&Hub::inertia_kg_m2>("hub", "inertia", "Ih", "kg m^2", kNotNegative, kRequired,
                               "of rotor and clamp about the motor axis"),
      hub<&Hub::viscous_friction_N_m_s_per_rad>("hub", "viscous_friction", "c", "N m s/rad",
                                                kNotNegative, kMayBeAbsent,
                                                "torque on the hub per angular velocity"),
      payload<&Payload::mass_kg>("payload", "mass", "Mp", "kg", kNotNegative, kMayBeAbsent,
                                 "of a rigid body fixed to the tip"),
      payload<&Payload::inertia_kg_m2>(
          "payload", "inertia", "Ip", "kg m^2", kNotNegative, kMayBeAbsent,
          "of that body about its centre of mass, which is at the tip"),
      damping<&Damping::kelvin_voigt_s>("damping", "kelvin_voigt", "kv", "s", kNotNegative,
                                        kMayBeAbsent,
                                        "bending moment = EI (y'' + kelvin_voigt d/dt y'')"),
  };
  return keys;
}

const std::vector<std::string>& arm_tables() {
  static const std::vector<std::string> tables = [] {
    std::vector<std::string> names;
    for (const auto& key : arm_keys()) {
      if (names.empty() || names.back() != key.table) names.push_back(key.table);
    }
    return names;
  }();
  return tables;
}

void require_in_range(const Arm& arm, std::string_view table) {
  for (const auto& key : arm_keys()) {
    if (key.table != table) continue;
    if (const auto value = key.get(arm)) {
      require_in_range(key.name(), *value, key.unit, key.range);
    }
  }
}

}  // namespace flexarm::arm
