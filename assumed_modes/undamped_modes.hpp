#pragma once

#include "assumed_modes/real.hpp"
#include "assumed_modes/ritz.hpp"
#include "assumed_modes/symmetric_pencil.hpp"

namespace flexarm::assumed_modes {

/// The modes of the undamped arm, the lowest (rigid-body) one first, in all coordinates. Without a
/// restoring force the lowest is the rigid rotation itself, its stiffness exactly 0.
RitzPairs undamped_modes(const SymmetricPencil& pencil, bool turns_freely);

/// The zeros of the hub angle: Ritz values, without vectors, of the arm whose hub, or rotor of a
/// compliant drive, is held.
RitzPairs hub_held_values(const SymmetricPencil& pencil);

/// What takes energy out of the arm, in coordinates that make `mass` and `stiffness` of RitzPairs
/// diagonal: Q^T (2 R) Q over m l^3 sqrt(EI/(m l^4)).
struct ModalDamping {
  Matrix whole;
  Real hub_friction = 0;
  Vector hub_rotation;  ///< of each mode, where the torque acts
  /// `whole` less hub_friction hub_rotation hub_rotation^T, where that is diagonal to the last bit:
  /// Kelvin-Voigt damping alone, and nothing but bending stiffness. Empty otherwise.
  Vector diagonal;
};

ModalDamping modal_damping(const AdmissibleFunctions& functions, const ScaledArm& arm,
                           const RitzPairs& modes);

}  // namespace flexarm::assumed_modes
