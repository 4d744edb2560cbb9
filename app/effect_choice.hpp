#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Adds `--effects` to a command.
void add_effect_choice(CLI::App& parser, std::vector<std::string>& effects);

}  // namespace flexarm::app
