#pragma once

#include "arm/linear_arm.hpp"
#include "exact_tf/scaled.hpp"

#include <optional>
#include <vector>

namespace flexarm::exact_tf {

/// The equations of a linear arm with every effect, from the energies of arm/linear_arm.hpp by
/// Hamilton's principle, in the Laplace variable s. With the bending moment M and the transverse
/// force Q along y,
///
///     M = EI (1 + kv s) psi',   Q = kGA (y' - psi) + g P(x) y',
///
/// the variations of psi and y on the beam leave
///
///     M' = rho I s^2 psi - Q + g P y',   Q' = (m s^2 + ca s) y,
///
/// so that with phi = 1/kGA the state (y, psi, M, Q) obeys
///
///     (1 + phi g P) y' = psi + phi Q
///     psi' = M/(EI (1 + kv s))
///     M' = rho I s^2 psi - Q + g P y'
///     Q' = (m s^2 + ca s) y,
///
/// an Euler-Bernoulli beam having phi = rho I = 0. Variations at the tip, the crack, the masses on
/// the beam, the root and the hub:
///
///     Q(l) = -s^2 (Mp y + Sp psi),   M(l) = -s^2 (Sp y + Jp psi) - g Sp psi
///     psi(X+) - psi(X-) = M(X)/kc,   y, M, Q continuous
///     Q(Xk+) - Q(Xk-) = mk s^2 (y + uk),   M(Xk+) - M(Xk-) = g mk uk,   y, psi continuous
///     (mk s^2 + ck s + kk) uk = -mk (s^2 y + g psi)   where mk is suspended, else uk = 0
///     y(0) = a theta,   psi(0) - theta = M(0)/(kr (1 + tr s))
///     taud = ((Ih - Jr) s^2 + g P(0) a) theta - M(0) - a Q(0)
///     theta_m - theta = taud/(kd (1 + td s))
///     tau = (Jr s^2 + c s + ks) theta_m + taud,
///
/// taud being what the drive passes on to the hub. Where the drive is rigid, theta_m = theta and
/// the rotor is a part of the hub.
///
/// The numbers of these equations in units of the beam: lengths in l, time in
/// sqrt(m l^4/EI), moments in EI/l, forces in EI/l^2.
struct ArmInBeamUnits {
  Real omega_scale_rad_per_s = 0.0L;  ///< sqrt(EI/(m l^4))
  Real length_m = 0.0L;               ///< l
  Real torque_scale_N_m = 0.0L;       ///< EI/l

  /// What of Ih/(m l^3) turns by theta, and by theta_m where the drive is compliant.
  Real hub_inertia = 0.0L;
  Real rotor_inertia = 0.0L;
  Real drive_flexibility = 0.0L;  ///< EI/(l kd), 0 for a rigid drive
  Real drive_retardation = 0.0L;  ///< td omega_scale
  Real hub_radius = 0.0L;        ///< a/l
  Real hub_friction = 0.0L;      ///< c omega_scale l/EI
  Real hub_spring = 0.0L;        ///< ks l/EI
  Real root_flexibility = 0.0L;  ///< EI/(l kr), 0 for a rigid root
  Real root_retardation = 0.0L;  ///< tr omega_scale

  Real payload_mass = 0.0L;     ///< Mp/(m l)
  Real payload_moment = 0.0L;   ///< Sp/(m l^2)
  Real payload_inertia = 0.0L;  ///< Jp/(m l^3)

  std::optional<Real> crack_position;  ///< X/l
  Real crack_flexibility = 0.0L;       ///< EI/(l kc)

  /// A mass on the beam.
  struct Carried {
    Real position = 0.0L;       ///< Xk/l
    Real mass = 0.0L;           ///< mk/(m l)
    Real omega_squared = 0.0L;  ///< kk/(mk omega_scale^2); 0 where the mass is fixed
    Real damping = 0.0L;        ///< ck/(mk omega_scale)

    bool is_suspended() const { return omega_squared > 0.0L; }
  };
  std::vector<Carried> carried;  ///< by position

  Real shear_flexibility = 0.0L;  ///< EI/(kGA l^2)
  Real rotary_inertia = 0.0L;     ///< rho I/(m l^2)
  Real gravity = 0.0L;            ///< g m l^3/EI
  Real kelvin_voigt = 0.0L;       ///< kv omega_scale
  Real air_damping = 0.0L;        ///< ca/(m omega_scale)

  bool has_rigid_drive() const { return drive_flexibility == 0.0L; }
  bool turns_freely() const { return hub_spring == 0.0L && gravity == 0.0L; }
  /// g P in units of l, the axial tension, at x and just before it towards the root.
  Real tension(Real x) const;
  /// I_T/(m l^3).
  Real total_inertia() const;
};

/// Formed in long double from the arm's doubles, which count as exact.
ArmInBeamUnits in_beam_units(const arm::LinearArm& arm);

/// What of these equations depends on s, in the same units.
template <class T>
struct BeamAtFrequency {
  T square;         ///< s^2
  T inertia;        ///< s^2 + ca s: Q' over y
  T rotary;         ///< rho I s^2
  T flexibility;    ///< 1/(1 + kv s): psi' over M
  T root;           ///< (psi(0) - theta)/M(0)
  T drive;          ///< (theta_m - theta)/taud
  T hub_impedance;  ///< (taud + M(0) + a Q(0))/theta; what acts on the rotor included where rigid
  T rotor_impedance;  ///< (tau - taud)/theta_m; 0 where the drive is rigid
  T decay;          ///< s times what damping is multiplied by: suspensions have ck times it
};

/// The undamped arm at s^2 = -omega_squared, of either sign.
BeamAtFrequency<Real> undamped_at(const ArmInBeamUnits& arm, Real omega_squared);
/// The undamped arm at complex s^2 = -omega_squared.
BeamAtFrequency<Complex> undamped_at(const ArmInBeamUnits& arm, const Complex& omega_squared);
/// The arm with all its damping times `damping`, at s in units of omega_scale.
BeamAtFrequency<Complex> damped_at(const ArmInBeamUnits& arm, const Complex& s,
                                   const Complex& damping = 1.0L);

}  // namespace flexarm::exact_tf
