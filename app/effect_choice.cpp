#include "app/effect_choice.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/sensor.hpp"
#include "effects/registry/vocabulary.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace flexarm::app {

namespace {

/// Throws InputError unless `name` is an effect, or an effect on a sensor.
void require_effect(const std::string& name, const std::vector<diagnose::Hypothesis>& all) {
  const auto is_named = [&](const diagnose::Hypothesis& one) {
    return one.effect == name || one.label() == name;
  };
  if (std::ranges::any_of(all, is_named)) return;
  constexpr std::string_view kOn = " on ";
  const std::string effect = name.substr(0, name.find(kOn));
  const std::string option = "--exclude " + arm::shown(name) + ": ";
  const effects::Entry* entry = effects::find(effect);
  if (entry == nullptr) {
    throw arm::InputError(option + arm::unknown_effect(effects::vocabulary(), effect));
  }
  if (effect.size() == name.size()) return;
  if (!entry->definition->sensor) {
    throw arm::InputError(fmt::format("{}{} acts on no sensor", option, effect));
  }
  try {
    arm::parse_sensor(std::string_view(name).substr(effect.size() + kOn.size()));
  } catch (const arm::InputError& error) {
    throw arm::InputError(option + error.what());
  }
}

}  // namespace

void add_effect_choice(CLI::App& parser, std::vector<std::string>& effects) {
  parser
      .add_option("--effects", effects,
                  "Effects to test, comma-separated; default: all of the library")
      ->delimiter(',')
      ->allow_extra_args(false);
}

std::vector<diagnose::Hypothesis> without_excluded(std::vector<diagnose::Hypothesis> all,
                                                   const std::vector<std::string>& excluded) {
  for (const auto& name : excluded) require_effect(name, all);
  auto left = diagnose::without(std::move(all), excluded);
  if (left.empty() && !excluded.empty()) {
    throw arm::InputError("--exclude: no effect is left to search for");
  }
  return left;
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
