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
template <class R>
struct ArmInBeamUnits {
  R omega_scale_rad_per_s = 0;  ///< sqrt(EI/(m l^4))
  R length_m = 0;               ///< l
  R torque_scale_N_m = 0;       ///< EI/l

  /// What of Ih/(m l^3) turns by theta, and by theta_m where the drive is compliant.
  R hub_inertia = 0;
  R rotor_inertia = 0;
  R drive_flexibility = 0;  ///< EI/(l kd), 0 for a rigid drive
  R drive_retardation = 0;  ///< td omega_scale
  R hub_radius = 0;         ///< a/l
  R hub_friction = 0;       ///< c omega_scale l/EI
  R hub_spring = 0;         ///< ks l/EI
  R root_flexibility = 0;   ///< EI/(l kr), 0 for a rigid root
  R root_retardation = 0;   ///< tr omega_scale

  R payload_mass = 0;     ///< Mp/(m l)
  R payload_moment = 0;   ///< Sp/(m l^2)
  R payload_inertia = 0;  ///< Jp/(m l^3)

  std::optional<R> crack_position;  ///< X/l
  R crack_flexibility = 0;          ///< EI/(l kc)

  /// A mass on the beam.
  struct Carried {
    R position = 0;       ///< Xk/l
    R mass = 0;           ///< mk/(m l)
    R omega_squared = 0;  ///< kk/(mk omega_scale^2); 0 where the mass is fixed
    R damping = 0;        ///< ck/(mk omega_scale)

    bool is_suspended() const { return omega_squared > 0; }
  };
  std::vector<Carried> carried;  ///< by position

  R shear_flexibility = 0;  ///< EI/(kGA l^2)
  R rotary_inertia = 0;     ///< rho I/(m l^2)
  R gravity = 0;            ///< g m l^3/EI
  R kelvin_voigt = 0;       ///< kv omega_scale
  R air_damping = 0;        ///< ca/(m omega_scale)

  bool has_rigid_drive() const { return drive_flexibility == 0; }
  bool turns_freely() const { return hub_spring == 0 && gravity == 0; }
  /// g P in units of l, the axial tension, at x and just before it towards the root.
  R tension(R x) const;
  /// I_T/(m l^3).
  R total_inertia() const;
};

/// Formed in long double from the arm's doubles, which count as exact, and rounded to R.
template <class R>
ArmInBeamUnits<R> in_beam_units(const arm::LinearArm& arm);

/// What of these equations depends on s, in the same units.
template <class T>
struct BeamAtFrequency {
  T square;           ///< s^2
  T inertia;          ///< s^2 + ca s: Q' over y
  T rotary;           ///< rho I s^2
  T flexibility;      ///< 1/(1 + kv s): psi' over M
  T root;             ///< (psi(0) - theta)/M(0)
  T drive;            ///< (theta_m - theta)/taud
  T hub_impedance;    ///< (taud + M(0) + a Q(0))/theta; what acts on the rotor included where rigid
  T rotor_impedance;  ///< (tau - taud)/theta_m; 0 where the drive is rigid
  T decay;            ///< s times what damping is multiplied by: suspensions have ck times it
};

/// The undamped arm at s^2 = -omega_squared, of either sign or complex.
template <class T>
BeamAtFrequency<T> undamped_at(const ArmInBeamUnits<RealOf<T>>& arm, const T& omega_squared);
/// The arm with all its damping times `damping`, at complex s in units of omega_scale.
template <class R>
BeamAtFrequency<std::complex<R>> damped_at(const ArmInBeamUnits<R>& arm, const std::complex<R>& s,
                                           const std::complex<R>& damping = R(1));

}  // namespace flexarm::exact_tf
