#include "assumed_modes/admissible_functions.hpp"

#include <stdexcept>

namespace flexarm::assumed_modes {

namespace {

std::variant<LegendreFunctions, BeamShapes> made(Basis basis, int count,
                                                 const InertiaRatios& payload) {
  switch (basis) {
    case Basis::legendre:
      return LegendreFunctions(count);
    case Basis::clamped_free:
      return BeamShapes::clamped(count, 0, 0);
    case Basis::pinned_free:
      return BeamShapes::pinned_free(count);
    case Basis::clamped_with_payload:
      return BeamShapes::clamped(count, payload.payload_mass, payload.payload_inertia);
  }
  throw std::logic_error("basis outside its enumeration");
}

}  // namespace

AdmissibleFunctions::AdmissibleFunctions(Basis basis, int count, const InertiaRatios& payload)
    : functions_(made(basis, count, payload)) {}

Integrals AdmissibleFunctions::integrals() const {
  return std::visit([](const auto& functions) { return functions.integrals(); }, functions_);
}

Vector AdmissibleFunctions::values(Real xi, int derivative) const {
  return std::visit([&](const auto& functions) { return functions.values(xi, derivative); },
                    functions_);
}

}  // namespace flexarm::assumed_modes
