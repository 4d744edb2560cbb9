#pragma once

#include "arm/arm.hpp"
#include "response/any_formulation.hpp"

#include <functional>
#include <string>
#include <vector>

namespace flexarm::compare {

/// A formulation at its settings, for any arm.
struct Model {
  std::string name;      ///< "exact_tf"
  std::string settings;  ///< "4 elements of degree 11"; empty where there are none
  std::function<response::AnyFormulation(const arm::Arm&)> make;
};

/// exact_tf, fem and assumed_modes at settings fine enough for `roots` roots, of the linear effects
/// of an arm alone (`response::make_formulation`, and what it throws).
std::vector<Model> standard_models(int roots);

}  // namespace flexarm::compare
