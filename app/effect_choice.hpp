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

/// The hypotheses without those of `--exclude`: effects by name ("sensor_gain"), or on one sensor
/// ("sensor_gain on tip_acceleration"). Throws InputError for an unknown effect or sensor, and
/// where nothing is left to search for. An effect that is not searched for anyway may be named.
std::vector<diagnose::Hypothesis> without_excluded(std::vector<diagnose::Hypothesis> all,
                                                   const std::vector<std::string>& excluded);

/// The hypotheses of these effects, all where none are named. Throws InputError for an unknown
/// effect, and for one that is not among the hypotheses; `option` named them.
std::vector<diagnose::Hypothesis> chosen_hypotheses(const std::vector<std::string>& effects,
                                                    std::vector<diagnose::Hypothesis> all,
                                                    const char* option = "--effects");

}  // namespace flexarm::app
