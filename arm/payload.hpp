#pragma once

namespace flexarm::arm {

/// A rigid body fixed to the tip, its centre of mass there unless an effect offsets it.
struct Payload {
  double mass_kg = 0.0;        ///< Mp, 0 or more
  double inertia_kg_m2 = 0.0;  ///< Ip about the centre of mass, 0 or more

  bool operator==(const Payload&) const = default;
};

}  // namespace flexarm::arm
