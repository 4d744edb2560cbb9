#include "arm/arm.hpp"

#include "arm/input_error.hpp"

#include <cmath>

namespace flexarm::arm {

namespace {

void require_not_negative(const char* key, double value, const char* unit) {
  if (!(std::isfinite(value) && value >= 0.0)) {
    throw out_of_range(key, value, unit, "a finite number, 0 or more");
  }
}

double beam_inertia_kg_m2(const Beam& beam) {
  return beam.linear_density_kg_per_m() * std::pow(beam.length_m, 3);
}

}  // namespace

void require_valid(const Arm& arm) {
  require_valid(arm.beam);
  require_not_negative("hub.inertia", arm.hub.inertia_kg_m2, "kg m^2");
  require_not_negative("hub.viscous_friction", arm.hub.viscous_friction_N_m_s_per_rad, "N m s/rad");
  require_not_negative("payload.mass", arm.payload.mass_kg, "kg");
  require_not_negative("payload.inertia", arm.payload.inertia_kg_m2, "kg m^2");
  require_not_negative("damping.kelvin_voigt", arm.damping.kelvin_voigt_s, "s");
  require_valid(arm.effects);
}

double total_inertia_kg_m2(const Arm& arm) {
  const double l = arm.beam.length_m;
  return arm.hub.inertia_kg_m2 + beam_inertia_kg_m2(arm.beam) / 3.0 + arm.payload.mass_kg * l * l +
         arm.payload.inertia_kg_m2;
}

double omega_scale_rad_per_s(const Arm& arm) {
  const double l = arm.beam.length_m;
  return std::sqrt(arm.beam.flexural_rigidity_N_m2() / arm.beam.linear_density_kg_per_m()) /
         (l * l);
}

double hub_inertia_ratio(const Arm& arm) {
  return arm.hub.inertia_kg_m2 / beam_inertia_kg_m2(arm.beam);
}

double payload_mass_ratio(const Arm& arm) {
  return arm.payload.mass_kg / (arm.beam.linear_density_kg_per_m() * arm.beam.length_m);
}

double payload_inertia_ratio(const Arm& arm) {
  return arm.payload.inertia_kg_m2 / beam_inertia_kg_m2(arm.beam);
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
