#pragma once

#include "arm/arm.hpp"
#include "arm/ports.hpp"

#include <array>
#include <optional>
#include <vector>

namespace flexarm::arm {

/// The numbers in the equations of a linear arm, its linear effects folded in. Every formulation
/// starts from these.
///
/// x is measured along the beam from its root, a = hub radius, theta the hub angle, y(x, t) the
/// displacement of the beam's axis from the resting line, psi the rotation of its cross-section,
/// [psi] the jump at the crack X. Hub and root: y(0) = a theta. Without shear psi = y', without
/// root compliance psi(0) = theta. The rotor, a part Jr of the hub's inertia, turns by theta_m;
/// without a compliant drive theta_m = theta and Jr is any part. The beam carries masses mk at Xk,
/// which move by y(Xk) + uk, with uk = 0 where there is no suspension.
///
///     2 T = Jr theta_m_t^2 + (Ih - Jr) theta_t^2 + int (m y_t^2 + rho I psi_t^2) dx
///           + Mp y_t(l)^2 + 2 Sp y_t(l) psi_t(l) + Jp psi_t(l)^2 + sum mk (y_t(Xk) + uk_t)^2
///     2 V = ks theta_m^2 + kd (theta_m - theta)^2 + kr (psi(0) - theta)^2 + kc [psi]^2
///           + int (EI psi'^2 + kGA (y' - psi)^2) dx + sum kk uk^2
///           + g (P(0) a theta^2 + int P y'^2 dx + Sp psi(l)^2 + sum 2 mk uk psi(Xk)),
///     P(x) = Mp + m (l - x) + sum over Xk > x of mk   (P(0) with those at 0)
///     2 R = c theta_m_t^2 + td kd (theta_m_t - theta_t)^2 + tr kr (psi_t(0) - theta_t)^2
///           + int (kv EI psi'_t^2 + ca y_t^2) dx + sum ck uk_t^2   (half the power lost)
///
/// and the torque does the work tau theta_m. The hub's sensors show theta_m, and every law of hub
/// torque acts on the rotor: where motor, brushes, bearings and encoder are. The crack and the
/// shear lose no energy. The terms in g are the potential of the mass beyond each place, the hub's
/// arm a, the payload's offset and the masses' own motion across the beam included.
struct LinearArm {
  double length_m = 0.0;                 ///< l, of the beam alone
  double flexural_rigidity_N_m2 = 0.0;   ///< EI
  double linear_density_kg_per_m = 0.0;  ///< m
  std::optional<double> thickness_m;     ///< strain sensors need it
  std::optional<ShearAndRotaryInertia> shear;
  std::optional<RotationalSpring> crack;  ///< kc at X, inside the beam
  /// mk above 0, by position; none that is fixed to the tip, which the payload's numbers hold.
  std::vector<MassOnBeam> masses;
  double kelvin_voigt_s = 0.0;            ///< kv
  double air_damping_N_s_per_m2 = 0.0;    ///< ca

  double hub_inertia_kg_m2 = 0.0;                    ///< Ih, the rotor's part included
  std::optional<Drive> drive;                        ///< Jr, kd, td; empty: the drive is rigid
  double hub_radius_m = 0.0;                         ///< a
  double hub_viscous_friction_N_m_s_per_rad = 0.0;   ///< c
  double hub_spring_N_m_per_rad = 0.0;               ///< ks
  std::optional<double> root_stiffness_N_m_per_rad;  ///< kr; empty: the root is rigid
  double root_retardation_s = 0.0;                   ///< tr, 0 where the root is rigid

  double payload_mass_kg = 0.0;            ///< Mp
  double payload_first_moment_kg_m = 0.0;  ///< Sp = Mp times its centre's distance beyond the tip
  double payload_tip_inertia_kg_m2 = 0.0;  ///< Jp, about the tip: own inertia + Mp distance^2
  double gravity_m_per_s2 = 0.0;           ///< g

  /// An Euler-Bernoulli beam in one piece that is rigidly fixed to a hub of no radius, with a
  /// payload at the tip and no restoring force but its own stiffness: the arm of arm/arm.hpp.
  bool is_plain() const;
  /// Nothing holds the hub: y = (a + x) theta costs no energy.
  bool turns_freely() const;
  /// Some damping is not zero.
  bool is_damped() const;

  bool operator==(const LinearArm&) const = default;
};

/// The ports that enter the linear arm: what a formulation honours.
inline constexpr std::array kLinearArmPorts = {Port::arm_number, Port::linear_term,
                                               Port::sensor_place};

/// The arm with the numbers that its effects change (Port::arm_number), and without these effects'
/// terms.
Arm with_changed_numbers(const Arm& arm);

/// What the arm's effects add to its linear equations (Port::linear_term).
LinearTerms linear_terms(const Arm& arm);

/// The arm's numbers with its effects through `kLinearArmPorts` applied; effects through other
/// ports do not enter. Springs at the root are in series. Payload inertias are about the payload's
/// centre of mass, which is at the tip unless an effect offsets it; a mass fixed to the tip is not
/// offset.
///
/// For a valid arm (`require_valid`). Throws InputError for a beam that is not known well enough,
/// for an effect that needs a number which the arm does not give, for several springs inside the
/// beam, and for several at the root of which one has a retardation.
LinearArm linear_arm(const Arm& arm);

/// I_T, the inertia of the rigid arm about the motor axis:
/// Ih + m ((a + l)^3 - a^3)/3 + rho I l + Mp (a + l)^2 + 2 Sp (a + l) + Jp
/// + sum mk (a + Xk)^2 [kg m^2].
double total_inertia_kg_m2(const LinearArm& arm);

/// sqrt(EI/(m l^4)): omega = lambda^2 times this, with lambda = beta l [rad/s].
double omega_scale_rad_per_s(const LinearArm& arm);

}  // namespace flexarm::arm
