#pragma once

#include "response/formulation_choice.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

using response::ChosenFormulation;
using response::FormulationChoice;

/// Adds `--formulation` and the settings of the discrete ones to a command.
void add_formulation_choice(CLI::App& parser, FormulationChoice& choice);

}  // namespace flexarm::app
