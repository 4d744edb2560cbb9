#include "diagnose/search/hypothesis_choice.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/sensor.hpp"
#include "effects/registry/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Throws InputError unless `name` is an effect, or an effect on a sensor.
void require_effect(const std::string& name, const std::vector<Hypothesis>& all,
                    std::string_view option) {
  const auto is_named = [&](const Hypothesis& one) {
    return one.effect == name || one.label() == name;
  };
  if (std::ranges::any_of(all, is_named)) return;
  constexpr std::string_view kOn = " on ";
  const std::string effect = name.substr(0, name.find(kOn));
  const std::string where = fmt::format("{} {}: ", option, arm::shown(name));
  const effects::Entry* entry = effects::find(effect);
  if (entry == nullptr) {
    throw arm::InputError(where + arm::unknown_effect(effects::vocabulary(), effect));
  }
  if (effect.size() == name.size()) return;
  if (!entry->definition->sensor) {
    throw arm::InputError(fmt::format("{}{} acts on no sensor", where, effect));
  }
  try {
    arm::parse_sensor(std::string_view(name).substr(effect.size() + kOn.size()));
  } catch (const arm::InputError& error) {
    throw arm::InputError(where + error.what());
  }
}

}  // namespace

std::vector<Hypothesis> chosen_hypotheses(const std::vector<std::string>& chosen,
                                          std::vector<Hypothesis> all, std::string_view option) {
  if (chosen.empty()) return all;
  for (const auto& name : chosen) {
    if (std::ranges::find(all, name, &Hypothesis::effect) != all.end()) continue;
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

std::vector<Hypothesis> without_excluded(std::vector<Hypothesis> all,
                                         const std::vector<std::string>& excluded,
                                         std::string_view option) {
  for (const auto& name : excluded) require_effect(name, all, option);
  auto left = without(std::move(all), excluded);
  if (left.empty() && !excluded.empty()) {
    throw arm::InputError(fmt::format("{}: no effect is left to search for", option));
  }
  return left;
}

}  // namespace flexarm::diagnose
