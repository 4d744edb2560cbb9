#include "arm/linear_arm.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::arm {

namespace {

/// Those at the beam's root are in series.
void place_springs(LinearArm& linear, const std::vector<RotationalSpring>& springs) {
  for (const RotationalSpring& spring : springs) {
    auto& root = linear.root_stiffness_N_m_per_rad;
    const double stiffness = spring.stiffness_N_m_per_rad;
    if (spring.position_m == 0.0) {
      const bool retarded = spring.retardation_s > 0.0 || linear.root_retardation_s > 0.0;
      if (root.has_value() && retarded) {
        throw InputError(
            "effects: several springs at the beam's root, one of them with damping (port "
            "linear_term); at most one");
      }
      root = root.has_value() ? 1.0 / (1.0 / *root + 1.0 / stiffness) : stiffness;
      linear.root_retardation_s = spring.retardation_s;
    } else if (linear.crack) {
      throw InputError("effects: several springs within the beam (port linear_term); at most one");
    } else {
      linear.crack = spring;
    }
  }
}

void place_masses(LinearArm& linear, const std::vector<MassOnBeam>& masses) {
  for (const MassOnBeam& mass : masses) {
    if (mass.mass_kg == 0.0) continue;
    if (mass.position_m == linear.length_m && !mass.suspension) {
      linear.payload_mass_kg += mass.mass_kg;
    } else {
      linear.masses.push_back(mass);
    }
  }
  std::ranges::stable_sort(linear.masses, {}, &MassOnBeam::position_m);
}

LinearTerms linear_terms_of(const Effects& effects, const Arm& changed) {
  LinearTerms terms;
  for (const auto& [name, effect] : effects) {
    if (effect.definition->linear_term) effect.definition->linear_term(effect, changed, terms);
  }
  return terms;
}

}  // namespace

Arm with_changed_numbers(const Arm& arm) {
  Arm changed = arm;
  for (const auto& [name, effect] : arm.effects) {
    if (effect.definition->arm_number) effect.definition->arm_number(effect, changed);
  }
  return changed;
}

LinearTerms linear_terms(const Arm& arm) {
  return linear_terms_of(arm.effects, with_changed_numbers(arm));
}

bool LinearArm::is_plain() const {
  return !shear && !crack && !drive && masses.empty() && !root_stiffness_N_m_per_rad &&
         air_damping_N_s_per_m2 == 0.0 && hub_radius_m == 0.0 && hub_spring_N_m_per_rad == 0.0 &&
         payload_first_moment_kg_m == 0.0 && gravity_m_per_s2 == 0.0;
}

bool LinearArm::turns_freely() const {
  return hub_spring_N_m_per_rad == 0.0 && gravity_m_per_s2 == 0.0;
}

bool LinearArm::is_damped() const {
  const auto is_damped_mass = [](const MassOnBeam& mass) {
    return mass.suspension && mass.suspension->damping_N_s_per_m > 0.0;
  };
  return kelvin_voigt_s > 0.0 || air_damping_N_s_per_m2 > 0.0 ||
         hub_viscous_friction_N_m_s_per_rad > 0.0 || root_retardation_s > 0.0 ||
         (drive && drive->retardation_s > 0.0) || std::ranges::any_of(masses, is_damped_mass);
}

LinearArm linear_arm(const Arm& given) {
  const Arm arm = with_changed_numbers(given);
  const LinearTerms terms = linear_terms_of(given.effects, arm);
  LinearArm linear;
  if (has_beam(arm)) {
    linear.length_m = arm.beam.length_m;
    linear.flexural_rigidity_N_m2 = arm.beam.flexural_rigidity_N_m2();
    linear.linear_density_kg_per_m = arm.beam.linear_density_kg_per_m();
    linear.thickness_m = arm.beam.thickness_m;
  }
  linear.shear = terms.shear;
  linear.kelvin_voigt_s = arm.damping.kelvin_voigt_s + terms.damping.kelvin_voigt_s;
  linear.air_damping_N_s_per_m2 = terms.damping.air_N_s_per_m2;

  linear.hub_inertia_kg_m2 = arm.hub.inertia_kg_m2;
  linear.drive = terms.drive;
  linear.hub_radius_m = terms.hub_radius_m;
  linear.hub_viscous_friction_N_m_s_per_rad =
      arm.hub.viscous_friction_N_m_s_per_rad + terms.damping.hub_N_m_s_per_rad;
  linear.hub_spring_N_m_per_rad = terms.hub_spring_N_m_per_rad;
  place_springs(linear, terms.springs);

  const double offset_m = terms.payload_offset_m;
  const double mass_kg = arm.payload.mass_kg + terms.tip_mass_kg;
  linear.payload_mass_kg = mass_kg;
  linear.payload_first_moment_kg_m = mass_kg * offset_m;
  linear.payload_tip_inertia_kg_m2 =
      arm.payload.inertia_kg_m2 + terms.tip_inertia_kg_m2 + mass_kg * offset_m * offset_m;
  linear.gravity_m_per_s2 = terms.gravity_m_per_s2;
  place_masses(linear, terms.masses);
  return linear;
}

double total_inertia_kg_m2(const LinearArm& arm) {
  const double l = arm.length_m;
  const double a = arm.hub_radius_m;
  const double reach = a + l;
  const double beam = arm.linear_density_kg_per_m * l * (a * reach + l * l / 3.0) +
                      (arm.shear ? arm.shear->rotary_inertia_kg_m * l : 0.0);
  double carried = 0.0;
  for (const MassOnBeam& mass : arm.masses) {
    carried += mass.mass_kg * (a + mass.position_m) * (a + mass.position_m);
  }
  return arm.hub_inertia_kg_m2 + beam + arm.payload_mass_kg * reach * reach +
         2.0 * arm.payload_first_moment_kg_m * reach + arm.payload_tip_inertia_kg_m2 + carried;
}

double omega_scale_rad_per_s(const LinearArm& arm) {
  return std::sqrt(arm.flexural_rigidity_N_m2 / arm.linear_density_kg_per_m) /
         (arm.length_m * arm.length_m);
}

}  // namespace flexarm::arm
