#pragma once

#include "diagnose/search/hypothesis.hpp"

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Adds `--effects` to a command.
void add_effect_choice(CLI::App& parser, std::vector<std::string>& effects);

/// The hypotheses of these effects, all where none are named. Throws InputError for an unknown
/// effect, and for one that is not among the hypotheses; `option` named them.
std::vector<diagnose::Hypothesis> chosen_hypotheses(const std::vector<std::string>& effects,
                                                    std::vector<diagnose::Hypothesis> all,
                                                    const char* option = "--effects");

}  // namespace flexarm::app
