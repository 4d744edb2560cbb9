#include "app/effect_choice.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace flexarm::app {

void add_effect_choice(CLI::App& parser, std::vector<std::string>& effects) {
  parser
      .add_option("--effects", effects,
                  "Effects to test, comma-separated; default: all of the library")
      ->delimiter(',')
      ->allow_extra_args(false);
}

std::vector<diagnose::Hypothesis> chosen_hypotheses(const std::vector<std::string>& chosen,
                                                    std::vector<diagnose::Hypothesis> all,
                                                    const char* option) {
  if (chosen.empty()) return all;
  for (const auto& name : chosen) {
    if (std::ranges::find(all, name, &diagnose::Hypothesis::effect) != all.end()) continue;
    if (effects::find(name) == nullptr) {
      throw arm::InputError(fmt::format("{} {}: {}", option, arm::shown(name),
                                        arm::unknown_effect(effects::vocabulary(), name)));
    }
    throw arm::InputError(fmt::format(
        "{} {}: has no influence on these runs, or is already in the arm file", option, name));
  }
  std::erase_if(all, [&](const auto& hypothesis) {
    return std::ranges::find(chosen, hypothesis.effect) == chosen.end();
  });
  return all;
}

}  // namespace flexarm::app
