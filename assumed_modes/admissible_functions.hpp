#pragma once

#include "assumed_modes/basis.hpp"
#include "assumed_modes/beam_shapes.hpp"
#include "assumed_modes/integrals.hpp"
#include "assumed_modes/legendre_functions.hpp"
#include "assumed_modes/real.hpp"

#include <variant>

namespace flexarm::assumed_modes {

/// The lumped inertias beside the link's own: Ih/(m l^3), Mp/(m l), Ip/(m l^3).
struct InertiaRatios {
  Real hub = 0;
  Real payload_mass = 0;
  Real payload_inertia = 0;
};

/// The flexible functions psi_i of a basis; the rigid rotation xi is not among them.
class AdmissibleFunctions {
 public:
  /// `payload` matters to `clamped_with_payload` only. count >= 1.
  AdmissibleFunctions(Basis basis, int count, const InertiaRatios& payload);

  Integrals integrals() const;
  /// psi_i, psi_i' or psi_i'' (derivative 0, 1, 2) at xi in [0, 1].
  Vector values(Real xi, int derivative) const;

 private:
  std::variant<LegendreFunctions, BeamShapes> functions_;
};

}  // namespace flexarm::assumed_modes
