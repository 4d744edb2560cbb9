#include "report/arm_json.hpp"

namespace flexarm::report {

nlohmann::ordered_json arm_json(const arm::Arm& arm) {
  return {
      {"name", arm.name},
      {"length_m", arm.beam.length_m},
      {"flexural_rigidity_N_m2", arm.beam.flexural_rigidity_N_m2()},
      {"linear_density_kg_per_m", arm.beam.linear_density_kg_per_m()},
      {"hub_inertia_kg_m2", arm.hub.inertia_kg_m2},
      {"hub_viscous_friction_N_m_s_per_rad", arm.hub.viscous_friction_N_m_s_per_rad},
      {"payload_mass_kg", arm.payload.mass_kg},
      {"payload_inertia_kg_m2", arm.payload.inertia_kg_m2},
      {"kelvin_voigt_s", arm.damping.kelvin_voigt_s},
      {"total_inertia_kg_m2", arm::total_inertia_kg_m2(arm)},
      {"hub_inertia_ratio", arm::hub_inertia_ratio(arm)},
      {"payload_mass_ratio", arm::payload_mass_ratio(arm)},
      {"payload_inertia_ratio", arm::payload_inertia_ratio(arm)},
  };
}

nlohmann::ordered_json complex_json(const std::optional<std::complex<double>>& value) {
  if (!value) return nullptr;
  return {{"re", value->real()}, {"im", value->imag()}};
}

}  // namespace flexarm::report
