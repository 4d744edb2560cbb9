#pragma once

#include "response/any_formulation.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// A formulation at its settings, and how to call them.
struct ChosenFormulation {
  std::string name;
  std::string settings;
  response::AnyFormulation formulation;
};

/// The formulation that a command works with.
struct FormulationChoice {
  std::string name = "exact_tf";
  std::optional<int> elements;
  std::optional<int> degree;
  std::optional<std::string> basis;
  std::optional<int> functions;

  /// Of the arm with its linear effects alone, at settings fine enough for `roots` roots unless the
  /// command line says otherwise. Throws InputError for an option that the formulation does not
  /// have.
  ChosenFormulation make(const arm::Arm& whole, int roots) const;
};

/// Adds `--formulation` and the settings of the discrete ones to a command.
void add_formulation_choice(CLI::App& parser, FormulationChoice& choice);

}  // namespace flexarm::app
