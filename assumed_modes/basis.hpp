#pragma once

#include "arm/arm.hpp"

#include <array>
#include <string_view>

namespace flexarm::assumed_modes {

/// Which admissible functions stand beside the rigid rotation.
enum class Basis {
  legendre,              ///< second derivatives are Legendre polynomials
  clamped_free,          ///< shapes of the cantilever without payload
  pinned_free,           ///< shapes of the pinned-free beam, without hub inertia and payload
  clamped_with_payload,  ///< shapes of the clamped beam that carries this arm's payload
};

inline constexpr std::array<Basis, 4> kAllBases = {Basis::legendre, Basis::clamped_free,
                                                   Basis::pinned_free, Basis::clamped_with_payload};

/// "legendre", "clamped_free", "pinned_free", "clamped_with_payload".
std::string_view to_string(Basis basis);

/// Reads what `to_string` writes. Throws InputError with the names allowed, and the one that was
/// probably meant.
Basis parse_basis(std::string_view name);

/// Throws InputError for the effect of the arm that no function of the basis can follow, by name:
/// shapes of a beam that is whole, bare between hub and tip, fixed to the hub and rigid in shear
/// neither turn in a soft drive, bend at a crack or at a soft root nor shear, nor does their shear
/// force jump at a mass. `legendre` has functions for each.
void require_representable(Basis basis, const arm::Arm& arm);
/// Whether that does not throw.
bool can_represent(Basis basis, const arm::Arm& arm);

}  // namespace flexarm::assumed_modes
