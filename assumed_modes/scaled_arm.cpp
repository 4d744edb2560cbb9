#include "assumed_modes/scaled_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::assumed_modes {

std::vector<Real> ScaledArm::breaks() const {
  // Nearer to each other than this two places are one, the first; a sliver gains nothing.
  constexpr Real kSamePlace = 1e-9L;
  std::vector<Real> places;
  if (crack) places.push_back(crack->position);
  for (const Carried& mass : carried) {
    const bool is_new = std::ranges::none_of(
        places, [&](Real place) { return std::abs(place - mass.position) <= kSamePlace; });
    const bool is_inside = mass.position > kSamePlace && 1 - mass.position > kSamePlace;
    if (is_new && is_inside) places.push_back(mass.position);
  }
  std::ranges::sort(places);
  return places;
}

Real ScaledArm::tension(Real xi) const {
  Real beyond = payload_mass + (1 - xi);
  for (const Carried& mass : carried) {
    if (mass.position >= xi) beyond += mass.mass;
  }
  return weight * beyond;
}

ScaledArm scaled(const arm::LinearArm& arm) {
  const Real l = arm.length_m;
  const Real density = arm.linear_density_kg_per_m;
  const Real torsion_N_m = static_cast<Real>(arm.flexural_rigidity_N_m2) / l;
  const Real mass_kg = density * l;
  const Real inertia_kg_m2 = mass_kg * l * l;
  const Real omega_rad_per_s = std::sqrt(torsion_N_m / inertia_kg_m2);

  ScaledArm scaled;
  Real hub_kg_m2 = arm.hub_inertia_kg_m2;
  if (arm.drive) {
    scaled.drive = {arm.drive->rotor_inertia_kg_m2 / inertia_kg_m2,
                    arm.drive->stiffness_N_m_per_rad / torsion_N_m,
                    arm.drive->retardation_s * omega_rad_per_s};
    hub_kg_m2 -= arm.drive->rotor_inertia_kg_m2;
  }
  scaled.hub_inertia = hub_kg_m2 / inertia_kg_m2;
  scaled.hub_radius = arm.hub_radius_m / l;
  scaled.hub_spring = arm.hub_spring_N_m_per_rad / torsion_N_m;
  if (arm.root_stiffness_N_m_per_rad) {
    scaled.root_stiffness = *arm.root_stiffness_N_m_per_rad / torsion_N_m;
  }
  if (arm.crack) {
    scaled.crack = {arm.crack->position_m / l, arm.crack->stiffness_N_m_per_rad / torsion_N_m};
  }
  scaled.root_retardation = arm.root_retardation_s * omega_rad_per_s;
  for (const arm::MassOnBeam& mass : arm.masses) {
    const arm::Suspension suspension = mass.suspension.value_or(arm::Suspension{});
    scaled.carried.push_back(
        {mass.position_m / l, mass.mass_kg / mass_kg,
         suspension.stiffness_N_per_m * l * l / torsion_N_m,
         suspension.damping_N_s_per_m * omega_rad_per_s * l * l / torsion_N_m});
  }
  if (arm.shear) {
    scaled.shear = {arm.shear->shear_rigidity_N * l / torsion_N_m,
                    arm.shear->rotary_inertia_kg_m / (mass_kg * l)};
  }
  scaled.payload_mass = arm.payload_mass_kg / mass_kg;
  scaled.payload_tip_inertia = arm.payload_tip_inertia_kg_m2 / inertia_kg_m2;
  scaled.payload_own_inertia = scaled.payload_tip_inertia;
  if (arm.payload_mass_kg > 0.0) {
    scaled.payload_offset =
        static_cast<Real>(arm.payload_first_moment_kg_m) / arm.payload_mass_kg / l;
    scaled.payload_own_inertia -=
        scaled.payload_mass * scaled.payload_offset * scaled.payload_offset;
    // Jp was rounded when Mp offset^2 was added to the inertia about the centre.
    constexpr Real kRounding = 4 * std::numeric_limits<double>::epsilon();
    if (scaled.payload_own_inertia <= kRounding * scaled.payload_tip_inertia) {
      scaled.payload_own_inertia = 0;
    }
  }
  scaled.weight = arm.gravity_m_per_s2 * mass_kg * l / torsion_N_m;
  scaled.kelvin_voigt = arm.kelvin_voigt_s * omega_rad_per_s;
  scaled.hub_friction = arm.hub_viscous_friction_N_m_s_per_rad * omega_rad_per_s / torsion_N_m;
  scaled.air_damping = arm.air_damping_N_s_per_m2 / (density * omega_rad_per_s);
  return scaled;
}

ScaledArm beyond_drive(ScaledArm arm) {
  arm.drive.reset();
  return arm;
}

}  // namespace flexarm::assumed_modes
