#include "assumed_modes/admissible_functions.hpp"

namespace flexarm::assumed_modes {

namespace {

std::variant<StrainFunctions, ShapeFunctions> made(Basis basis, const ScaledArm& arm, int functions,
                                                   int more) {
  if (basis == Basis::legendre) {
    return StrainFunctions(arm, {.on_whole_beam = functions - 1, .more = more});
  }
  return ShapeFunctions(basis, arm, functions - 1 + more);
}

}  // namespace

AdmissibleFunctions::AdmissibleFunctions(Basis basis, const ScaledArm& arm, int functions, int more)
    : functions_(made(basis, arm, functions, more)) {}

Eigen::Index AdmissibleFunctions::size() const {
  return std::visit([](const auto& functions) { return functions.size(); }, functions_);
}

const Vector& AdmissibleFunctions::bends() const {
  return std::visit([](const auto& functions) -> const Vector& { return functions.bends(); },
                    functions_);
}

Vector AdmissibleFunctions::motor_rotation() const {
  return std::visit([](const auto& functions) { return functions.motor_rotation(); }, functions_);
}

Vector AdmissibleFunctions::hub_rotation() const {
  return std::visit([](const auto& functions) -> Vector { return functions.hub_rotation(); },
                    functions_);
}

Vector AdmissibleFunctions::displacement(Real xi) const {
  return std::visit([xi](const auto& functions) { return functions.displacement(xi); }, functions_);
}

Vector AdmissibleFunctions::rotation(Real xi) const {
  return std::visit([xi](const auto& functions) { return functions.rotation(xi); }, functions_);
}

Vector AdmissibleFunctions::curvature(Real xi) const {
  return std::visit([xi](const auto& functions) { return functions.curvature(xi); }, functions_);
}

Matrix AdmissibleFunctions::displacement_products() const {
  return std::visit([](const auto& functions) { return functions.displacement_products(); },
                    functions_);
}

Matrix AdmissibleFunctions::rotation_products() const {
  return std::get<StrainFunctions>(functions_).rotation_products();
}

Matrix AdmissibleFunctions::slope_products(const ScaledArm& arm) const {
  return std::visit([&](const auto& functions) { return functions.slope_products(arm); },
                    functions_);
}

Vector AdmissibleFunctions::carried_displacement(std::size_t k) const {
  return std::get<StrainFunctions>(functions_).carried_displacement(k);
}

Vector AdmissibleFunctions::root_turn() const {
  return rotation(0) - hub_rotation();
}

Vector AdmissibleFunctions::drive_turn() const {
  return hub_rotation() - motor_rotation();
}

Vector AdmissibleFunctions::extension(std::size_t k) const {
  return std::get<StrainFunctions>(functions_).extension(k);
}

}  // namespace flexarm::assumed_modes
