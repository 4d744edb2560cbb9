#pragma once

namespace flexarm::arm {

/// Damping of the beam's material.
struct Damping {
  double kelvin_voigt_s = 0.0;  ///< kv: bending moment EI (y'' + kv d/dt y''), 0 or more

  bool operator==(const Damping&) const = default;
};

}  // namespace flexarm::arm
