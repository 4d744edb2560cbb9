#pragma once

namespace flexarm::arm {

/// The motor's rotor and clamp, on which the torque acts.
struct Hub {
  double inertia_kg_m2 = 0.0;                   ///< Ih, 0 or more
  double viscous_friction_N_m_s_per_rad = 0.0;  ///< c: torque -c theta', 0 or more

  bool operator==(const Hub&) const = default;
};

}  // namespace flexarm::arm
