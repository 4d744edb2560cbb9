#pragma once

#include "arm/linear_arm.hpp"
#include "assumed_modes/real.hpp"

#include <optional>
#include <vector>

namespace flexarm::assumed_modes {

/// The numbers of arm/linear_arm.hpp in units of l, m l and sqrt(m l^4/EI): xi = x/l from 0 to 1,
/// moments in EI/l, inertias in m l^3.
struct ScaledArm {
  struct Crack {
    Real position = 0;   ///< X/l
    Real stiffness = 0;  ///< kc l/EI
  };
  struct Shear {
    Real rigidity = 0;        ///< k G A l^2/EI
    Real rotary_inertia = 0;  ///< rho I/(m l^2)
  };

  struct Drive {
    Real rotor_inertia = 0;  ///< Jr/(m l^3)
    Real stiffness = 0;      ///< kd l/EI
    Real retardation = 0;    ///< td sqrt(EI/(m l^4))
  };

  /// A mass on the beam.
  struct Carried {
    Real position = 0;   ///< Xk/l
    Real mass = 0;       ///< mk/(m l)
    Real stiffness = 0;  ///< kk l^3/EI of its suspension; 0 where it is fixed
    Real damping = 0;    ///< ck l^2/sqrt(EI m l^2)

    bool is_suspended() const { return stiffness > 0; }
  };

  std::optional<Drive> drive;          ///< empty where it is rigid
  Real hub_inertia = 0;                ///< Ih/(m l^3), less the rotor's part beyond a drive
  Real hub_radius = 0;                 ///< a/l
  Real hub_spring = 0;                 ///< ks l/EI
  std::optional<Real> root_stiffness;  ///< kr l/EI
  Real root_retardation = 0;           ///< tr sqrt(EI/(m l^4))
  std::optional<Crack> crack;
  std::optional<Shear> shear;
  std::vector<Carried> carried;  ///< by position
  Real payload_mass = 0;    ///< Mp/(m l)
  Real payload_offset = 0;  ///< Sp/(Mp l), of the payload's centre beyond the tip; 0 without Mp
  Real payload_own_inertia = 0;  ///< (Jp - Sp^2/Mp)/(m l^3), about that centre
  Real payload_tip_inertia = 0;  ///< Jp/(m l^3)
  Real weight = 0;               ///< g m l^3/EI, of the beam
  Real kelvin_voigt = 0;         ///< kv sqrt(EI/(m l^4))
  Real hub_friction = 0;         ///< c/sqrt(EI m l^2)
  Real air_damping = 0;          ///< ca/(m sqrt(EI/(m l^4)))

  bool turns_freely() const { return hub_spring == 0 && weight == 0; }
  /// Places inside the beam at which a solution is not smooth, ascending.
  std::vector<Real> breaks() const;
  /// g P l^2/EI at xi, that of a mass there included.
  Real tension(Real xi) const;
};

ScaledArm scaled(const arm::LinearArm& arm);

/// The arm beyond its drive, the torque on the hub itself. What the drive passes on is a factor of
/// every response beyond it: their zeros are those of this arm.
ScaledArm beyond_drive(ScaledArm arm);

}  // namespace flexarm::assumed_modes
