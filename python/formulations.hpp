#pragma once

#include "arm/arm.hpp"
#include "response/any_formulation.hpp"
#include "response/linear_chain.hpp"

#include <optional>
#include <string>

namespace flexarm::python {

/// A formulation of an arm, beside what the arm has outside of its linear equations.
struct Formulation {
  arm::Arm arm;                          ///< whole, as it was given
  response::AnyFormulation formulation;  ///< of its linear part
  response::LinearChain chain;           ///< of actuator and sensors
  std::string settings;                  ///< "4 elements of degree 11"; empty where there are none
};

struct ExactTransferFunction : Formulation {
  explicit ExactTransferFunction(const arm::Arm& arm);
};

struct FiniteElements : Formulation {
  FiniteElements(const arm::Arm& arm, std::optional<int> elements, std::optional<int> degree,
                 int roots);
};

struct AssumedModes : Formulation {
  AssumedModes(const arm::Arm& arm, std::optional<int> functions,
               const std::optional<std::string>& basis, int roots);
};

struct RigidHub : Formulation {
  explicit RigidHub(const arm::Arm& arm);
};

}  // namespace flexarm::python
