#pragma once

#include "arm/beam.hpp"
#include "arm/effects.hpp"
#include "arm/payload.hpp"

#include <map>
#include <string>

namespace flexarm::arm {

/// The motor's rotor and clamp, on which the torque acts.
struct Hub {
  double inertia_kg_m2 = 0.0;                   ///< Ih, 0 or more
  double viscous_friction_N_m_s_per_rad = 0.0;  ///< c: torque -c theta', 0 or more

  bool operator==(const Hub&) const = default;
};

/// Damping of the beam's material.
struct Damping {
  double kelvin_voigt_s = 0.0;  ///< kv: bending moment EI (y'' + kv d/dt y''), 0 or more

  bool operator==(const Damping&) const = default;
};

/// A single-link flexible manipulator: a uniform beam turned about its root by a motor, with a
/// payload at its tip.
///
/// y(x, t) is the displacement of the beam at x from the line that the arm rests on, hub rotation
/// included; theta = y'(0, t); tau the torque on the hub; [0, l] the beam:
///
///     EI (1 + kv d/dt) y'''' + m y_tt = 0
///     y(0) = 0
///     Ih theta_tt + c theta_t - EI (1 + kv d/dt) y''(0) = tau
///     EI (1 + kv d/dt) y'''(l) = Mp y_tt(l)
///     EI (1 + kv d/dt) y''(l) = -Ip y'_tt(l)
struct Arm {
  std::string name;
  Beam beam;
  Hub hub;
  Payload payload;
  Damping damping;
  Effects effects;
  /// Standard deviations of numbers of the arm file relative to these, by key
  /// ("beam.youngs_modulus"; arm/uncertainties.hpp): what a fit may change beside effects.
  std::map<std::string, double> relative_uncertainties = {};
  /// Laws of hub torque that the file states and whose numbers are to be found, by name. One whose
  /// numbers have values beside their ranges is among the effects too.
  std::map<std::string, HubTorqueHypothesis> hypotheses = {};

  bool operator==(const Arm&) const = default;
};

/// Throws InputError for the first value that is not finite or out of its range.
void require_valid(const Arm& arm);

/// The arm without the effects that are only supposed: those that are also hypotheses.
Arm without_hypotheses(const Arm& arm);

/// The figures below are those of the arm with its linear effects applied (arm/linear_arm.hpp).

/// I_T, the inertia of the rigid arm about the motor axis; without effects
/// Ih + m l^3/3 + Mp l^2 + Ip [kg m^2].
double total_inertia_kg_m2(const Arm& arm);

/// sqrt(EI/(m l^4)): omega = lambda^2 times this, with lambda = beta l [rad/s].
double omega_scale_rad_per_s(const Arm& arm);

/// epsilon = Ih/(m l^3), equation (20) of the paper without its factor 3.
double hub_inertia_ratio(const Arm& arm);
/// eta = Mp/(m l), equation (20).
double payload_mass_ratio(const Arm& arm);
/// Ip/(m l^3).
double payload_inertia_ratio(const Arm& arm);

/// The arm of the paper's Table 1: aluminium link, no payload, no damping.
Arm paper_arm();

}  // namespace flexarm::arm
