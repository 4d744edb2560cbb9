#include "exact_tf/beam_units.hpp"

#include <cmath>

namespace flexarm::exact_tf {

namespace {

/// What the hub's weight does, g P(0) a, in units of EI/l.
template <class R>
R hub_weight(const ArmInBeamUnits<R>& arm) {
  return arm.tension(R(0)) * arm.hub_radius;
}

/// Impedances of what turns by theta and by theta_m; `on_motor` is that of the laws at the motor.
template <class T>
struct Impedances {
  T hub;
  T rotor;
};
template <class T>
Impedances<T> impedances(const ArmInBeamUnits<RealOf<T>>& arm, const T& square, const T& on_motor) {
  if (arm.has_rigid_drive()) {
    return {arm.hub_inertia * square + (on_motor + hub_weight(arm)), T(0)};
  }
  return {arm.hub_inertia * square + hub_weight(arm), arm.rotor_inertia * square + on_motor};
}

}  // namespace

template <class R>
R ArmInBeamUnits<R>::total_inertia() const {
  const R reach = hub_radius + 1;
  R sum = hub_inertia + rotor_inertia + hub_radius * reach + R(1) / 3 + rotary_inertia +
          payload_mass * reach * reach + 2 * payload_moment * reach + payload_inertia;
  for (const Carried& one : carried) {
    sum += one.mass * (hub_radius + one.position) * (hub_radius + one.position);
  }
  return sum;
}

template <class R>
R ArmInBeamUnits<R>::tension(R x) const {
  if (gravity == 0) return 0;
  R beyond = payload_mass + (1 - x);
  for (const Carried& one : carried) {
    if (one.position >= x) beyond += one.mass;
  }
  return gravity * beyond;
}

template <class R>
ArmInBeamUnits<R> in_beam_units(const arm::LinearArm& arm) {
  const auto rounded = [](Real value) { return static_cast<R>(value); };
  const Real l = arm.length_m;
  const Real rigidity = arm.flexural_rigidity_N_m2;
  const Real density = arm.linear_density_kg_per_m;
  const Real mass = density * l;
  const Real omega = std::sqrt(rigidity / density) / (l * l);
  const Real torque = rigidity / l;
  ArmInBeamUnits<R> units;
  units.omega_scale_rad_per_s = rounded(omega);
  units.length_m = rounded(l);
  units.torque_scale_N_m = rounded(torque);

  Real hub_kg_m2 = arm.hub_inertia_kg_m2;
  if (arm.drive) {
    hub_kg_m2 -= arm.drive->rotor_inertia_kg_m2;
    units.rotor_inertia = rounded(arm.drive->rotor_inertia_kg_m2 / (mass * l * l));
    units.drive_flexibility = rounded(torque / arm.drive->stiffness_N_m_per_rad);
    units.drive_retardation = rounded(arm.drive->retardation_s * omega);
  }
  units.hub_inertia = rounded(hub_kg_m2 / (mass * l * l));
  units.hub_radius = rounded(arm.hub_radius_m / l);
  units.hub_friction = rounded(arm.hub_viscous_friction_N_m_s_per_rad * omega / torque);
  units.hub_spring = rounded(arm.hub_spring_N_m_per_rad / torque);
  if (arm.root_stiffness_N_m_per_rad) {
    units.root_flexibility = rounded(torque / *arm.root_stiffness_N_m_per_rad);
  }
  units.root_retardation = rounded(arm.root_retardation_s * omega);
  for (const arm::MassOnBeam& one : arm.masses) {
    auto& carried = units.carried.emplace_back();
    carried.position = rounded(one.position_m / l);
    carried.mass = rounded(one.mass_kg / mass);
    if (one.suspension) {
      carried.omega_squared =
          rounded(one.suspension->stiffness_N_per_m / (one.mass_kg * omega * omega));
      carried.damping = rounded(one.suspension->damping_N_s_per_m / (one.mass_kg * omega));
    }
  }
  units.payload_mass = rounded(arm.payload_mass_kg / mass);
  units.payload_moment = rounded(arm.payload_first_moment_kg_m / (mass * l));
  units.payload_inertia = rounded(arm.payload_tip_inertia_kg_m2 / (mass * l * l));
  if (arm.crack) {
    units.crack_position = rounded(arm.crack->position_m / l);
    units.crack_flexibility = rounded(torque / arm.crack->stiffness_N_m_per_rad);
  }
  if (arm.shear) {
    units.shear_flexibility = rounded(rigidity / (arm.shear->shear_rigidity_N * l * l));
    units.rotary_inertia = rounded(arm.shear->rotary_inertia_kg_m / (mass * l));
  }
  units.gravity = rounded(arm.gravity_m_per_s2 * mass * l * l / rigidity);
  units.kelvin_voigt = rounded(arm.kelvin_voigt_s * omega);
  units.air_damping = rounded(arm.air_damping_N_s_per_m2 / (density * omega));
  return units;
}

template <class T>
BeamAtFrequency<T> undamped_at(const ArmInBeamUnits<RealOf<T>>& arm, const T& omega_squared) {
  const T square = -omega_squared;
  const auto impedance = impedances<T>(arm, square, T(arm.hub_spring));
  return {square,
          square,
          arm.rotary_inertia * square,
          T(1),
          T(arm.root_flexibility),
          T(arm.drive_flexibility),
          impedance.hub,
          impedance.rotor,
          T(0)};
}

template <class R>
BeamAtFrequency<std::complex<R>> damped_at(const ArmInBeamUnits<R>& arm, const std::complex<R>& s,
                                           const std::complex<R>& damping) {
  using T = std::complex<R>;
  const T square = s * s;
  const T decay = damping * s;
  const auto impedance = impedances<T>(arm, square, arm.hub_friction * decay + arm.hub_spring);
  return {square,
          square + arm.air_damping * decay,
          arm.rotary_inertia * square,
          R(1) / (R(1) + arm.kelvin_voigt * decay),
          arm.root_flexibility / (R(1) + arm.root_retardation * decay),
          arm.drive_flexibility / (R(1) + arm.drive_retardation * decay),
          impedance.hub,
          impedance.rotor,
          decay};
}

template struct ArmInBeamUnits<Real>;
template struct ArmInBeamUnits<double>;
template ArmInBeamUnits<Real> in_beam_units(const arm::LinearArm&);
template ArmInBeamUnits<double> in_beam_units(const arm::LinearArm&);
template BeamAtFrequency<Real> undamped_at(const ArmInBeamUnits<Real>&, const Real&);
template BeamAtFrequency<Complex> undamped_at(const ArmInBeamUnits<Real>&, const Complex&);
template BeamAtFrequency<double> undamped_at(const ArmInBeamUnits<double>&, const double&);
template BeamAtFrequency<std::complex<double>> undamped_at(const ArmInBeamUnits<double>&,
                                                           const std::complex<double>&);
template BeamAtFrequency<Complex> damped_at(const ArmInBeamUnits<Real>&, const Complex&,
                                            const Complex&);
template BeamAtFrequency<std::complex<double>> damped_at(const ArmInBeamUnits<double>&,
                                                         const std::complex<double>&,
                                                         const std::complex<double>&);

}  // namespace flexarm::exact_tf
