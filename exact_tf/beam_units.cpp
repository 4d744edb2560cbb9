#include "exact_tf/beam_units.hpp"

#include <cmath>

namespace flexarm::exact_tf {

namespace {

/// What the hub's weight does, g P(0) a, in units of EI/l.
Real hub_weight(const ArmInBeamUnits& arm) {
  return arm.tension(0.0L) * arm.hub_radius;
}

/// Impedances of what turns by theta and by theta_m; `on_motor` is that of the laws at the motor.
template <class T>
struct Impedances {
  T hub;
  T rotor;
};
template <class T>
Impedances<T> impedances(const ArmInBeamUnits& arm, const T& square, const T& on_motor) {
  if (arm.has_rigid_drive()) {
    return {arm.hub_inertia * square + (on_motor + hub_weight(arm)), T(0.0L)};
  }
  return {arm.hub_inertia * square + hub_weight(arm), arm.rotor_inertia * square + on_motor};
}

template <class T>
BeamAtFrequency<T> undamped(const ArmInBeamUnits& arm, const T& omega_squared) {
  const T square = -omega_squared;
  const auto impedance = impedances<T>(arm, square, T(arm.hub_spring));
  return {square,
          square,
          arm.rotary_inertia * square,
          T(1.0L),
          T(arm.root_flexibility),
          T(arm.drive_flexibility),
          impedance.hub,
          impedance.rotor,
          T(0.0L)};
}

}  // namespace

Real ArmInBeamUnits::total_inertia() const {
  const Real reach = hub_radius + 1.0L;
  Real sum = hub_inertia + rotor_inertia + hub_radius * reach + 1.0L / 3.0L + rotary_inertia +
             payload_mass * reach * reach + 2.0L * payload_moment * reach + payload_inertia;
  for (const Carried& one : carried) {
    sum += one.mass * (hub_radius + one.position) * (hub_radius + one.position);
  }
  return sum;
}

Real ArmInBeamUnits::tension(Real x) const {
  if (gravity == 0.0L) return 0.0L;
  Real beyond = payload_mass + (1.0L - x);
  for (const Carried& one : carried) {
    if (one.position >= x) beyond += one.mass;
  }
  return gravity * beyond;
}

ArmInBeamUnits in_beam_units(const arm::LinearArm& arm) {
  const Real l = arm.length_m;
  const Real rigidity = arm.flexural_rigidity_N_m2;
  const Real density = arm.linear_density_kg_per_m;
  const Real mass = density * l;
  ArmInBeamUnits units;
  units.omega_scale_rad_per_s = std::sqrt(rigidity / density) / (l * l);
  units.length_m = l;
  units.torque_scale_N_m = rigidity / l;
  const Real omega = units.omega_scale_rad_per_s;

  Real hub_kg_m2 = arm.hub_inertia_kg_m2;
  if (arm.drive) {
    hub_kg_m2 -= arm.drive->rotor_inertia_kg_m2;
    units.rotor_inertia = arm.drive->rotor_inertia_kg_m2 / (mass * l * l);
    units.drive_flexibility = units.torque_scale_N_m / arm.drive->stiffness_N_m_per_rad;
    units.drive_retardation = arm.drive->retardation_s * omega;
  }
  units.hub_inertia = hub_kg_m2 / (mass * l * l);
  units.hub_radius = arm.hub_radius_m / l;
  units.hub_friction = arm.hub_viscous_friction_N_m_s_per_rad * omega / units.torque_scale_N_m;
  units.hub_spring = arm.hub_spring_N_m_per_rad / units.torque_scale_N_m;
  if (arm.root_stiffness_N_m_per_rad) {
    units.root_flexibility = units.torque_scale_N_m / *arm.root_stiffness_N_m_per_rad;
  }
  units.root_retardation = arm.root_retardation_s * omega;
  for (const arm::MassOnBeam& one : arm.masses) {
    ArmInBeamUnits::Carried carried{one.position_m / l, one.mass_kg / mass};
    if (one.suspension) {
      carried.omega_squared = one.suspension->stiffness_N_per_m / (one.mass_kg * omega * omega);
      carried.damping = one.suspension->damping_N_s_per_m / (one.mass_kg * omega);
    }
    units.carried.push_back(carried);
  }
  units.payload_mass = arm.payload_mass_kg / mass;
  units.payload_moment = arm.payload_first_moment_kg_m / (mass * l);
  units.payload_inertia = arm.payload_tip_inertia_kg_m2 / (mass * l * l);
  if (arm.crack) {
    units.crack_position = arm.crack->position_m / l;
    units.crack_flexibility = units.torque_scale_N_m / arm.crack->stiffness_N_m_per_rad;
  }
  if (arm.shear) {
    units.shear_flexibility = rigidity / (arm.shear->shear_rigidity_N * l * l);
    units.rotary_inertia = arm.shear->rotary_inertia_kg_m / (mass * l);
  }
  units.gravity = arm.gravity_m_per_s2 * mass * l * l / rigidity;
  units.kelvin_voigt = arm.kelvin_voigt_s * omega;
  units.air_damping = arm.air_damping_N_s_per_m2 / (density * omega);
  return units;
}

BeamAtFrequency<Real> undamped_at(const ArmInBeamUnits& arm, Real omega_squared) {
  return undamped(arm, omega_squared);
}

BeamAtFrequency<Complex> undamped_at(const ArmInBeamUnits& arm, const Complex& omega_squared) {
  return undamped(arm, omega_squared);
}

BeamAtFrequency<Complex> damped_at(const ArmInBeamUnits& arm, const Complex& s,
                                   const Complex& damping) {
  const Complex square = s * s;
  const Complex decay = damping * s;
  const auto impedance =
      impedances<Complex>(arm, square, arm.hub_friction * decay + arm.hub_spring);
  return {square,
          square + arm.air_damping * decay,
          arm.rotary_inertia * square,
          1.0L / (1.0L + arm.kelvin_voigt * decay),
          arm.root_flexibility / (1.0L + arm.root_retardation * decay),
          arm.drive_flexibility / (1.0L + arm.drive_retardation * decay),
          impedance.hub,
          impedance.rotor,
          decay};
}

}  // namespace flexarm::exact_tf
