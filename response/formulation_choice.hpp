#pragma once

#include "arm/option_name.hpp"
#include "response/any_formulation.hpp"

#include <optional>
#include <string>

namespace flexarm::response {

/// A formulation at its settings, and how to call them.
struct ChosenFormulation {
  std::string name;
  std::string settings;
  AnyFormulation formulation;
};

/// A formulation by name, and its settings where they are given.
struct FormulationChoice {
  std::string name = "exact_tf";
  std::optional<int> elements = {};
  std::optional<int> degree = {};
  std::optional<std::string> basis = {};
  std::optional<int> functions = {};
  arm::OptionSpelling spelled = arm::on_command_line;  ///< of options in errors

  /// Returns the most roots that `make` takes: kMostRoots, and no limit for exact_tf.
  int most_roots() const;

  /// Of the arm with its linear effects alone, at settings fine enough for `roots` roots unless
  /// they are given. Throws InputError for a setting that the formulation does not have.
  ChosenFormulation make(const arm::Arm& whole, int roots) const;
};

}  // namespace flexarm::response
