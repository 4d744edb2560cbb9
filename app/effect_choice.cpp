#include "app/effect_choice.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace flexarm::app {

void add_effect_choice(CLI::App& parser, std::vector<std::string>& effects) {
  parser
      .add_option("--effects", effects,
                  "Causes to try, separated by commas; the whole vocabulary unless given")
      ->delimiter(',')
      ->allow_extra_args(false);
}

std::vector<diagnose::Hypothesis> chosen_hypotheses(const std::vector<std::string>& effects,
                                                    std::vector<diagnose::Hypothesis> all,
                                                    const char* option) {
  if (effects.empty()) return all;
  std::vector<std::string> names;
  for (const auto& entry : arm::effect_vocabulary()) names.push_back(entry.name);
  for (const auto& name : effects) {
    if (arm::find_effect(name) == nullptr) {
      throw arm::InputError(fmt::format("{} {}: unknown effect{}; allowed: {}", option,
                                        arm::shown(name), arm::did_you_mean(name, names),
                                        fmt::join(names, ", ")));
    }
    if (std::ranges::find(all, name, &diagnose::Hypothesis::effect) == all.end()) {
      throw arm::InputError(fmt::format(
          "{} {}: shows in none of these runs, or the arm file has it already", option, name));
    }
  }
  std::erase_if(all, [&](const auto& hypothesis) {
    return std::ranges::find(effects, hypothesis.effect) == effects.end();
  });
  return all;
}

}  // namespace flexarm::app
