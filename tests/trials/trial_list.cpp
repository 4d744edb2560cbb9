#include "tests/trials/trial_list.hpp"

#include "arm/input_error.hpp"

#include <boost/algorithm/string.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace flexarm::trials {

namespace {

measured::RunKind parse_kind(const std::string& name) {
  for (const auto kind :
       {measured::RunKind::time, measured::RunKind::frf, measured::RunKind::modal}) {
    if (measured::to_string(kind) == name) return kind;
  }
  throw arm::InputError(fmt::format("--kind {}: must be time, frf or modal", name));
}

Strength parse_strength(const std::string& name) {
  for (const Strength strength : kStrengths) {
    if (to_string(strength) == name) return strength;
  }
  throw arm::InputError(fmt::format("--strength {}: must be faint, weak, middle or strong", name));
}

/// Two effects of the vocabulary that this kind of data shows, by chance.
std::vector<std::string> draw_pair(measured::RunKind kind, Random& random) {
  std::vector<std::string> names;
  for (const Cause& cause : causes()) {
    if (!cause.outside && cause.in_pairs && cause.shows_in(kind)) names.push_back(cause.name);
  }
  const std::size_t first = random.below(names.size());
  const std::size_t second = (first + 1 + random.below(names.size() - 1)) % names.size();
  return {names[first], names[second]};
}

std::vector<std::vector<std::string>> hidden_sets(const std::string& word, measured::RunKind kind) {
  if (word == "none") return {{}};
  std::vector<std::vector<std::string>> sets;
  if (word == "single" || word == "outside") {
    for (const Cause& cause : causes()) {
      if (cause.outside == (word == "outside") && cause.shows_in(kind))
        sets.push_back({cause.name});
    }
    return sets;
  }
  std::vector<std::string> together;
  boost::split(together, word, boost::is_any_of("+"));
  const bool all_show = std::ranges::all_of(
      together, [&](const std::string& name) { return find_cause(name).shows_in(kind); });
  if (all_show) sets.push_back(std::move(together));
  return sets;
}

}  // namespace

std::vector<TrialKey> list_trials(const TrialChoice& choice) {
  std::vector<TrialKey> keys;
  const auto add = [&](TrialKey key) {
    // What is not hidden has no strength: once is enough.
    const bool known =
        std::ranges::any_of(keys, [&](const TrialKey& other) { return other.id() == key.id(); });
    if (!known) keys.push_back(std::move(key));
  };
  for (const std::string& kind_name : choice.kinds) {
    const measured::RunKind kind = parse_kind(kind_name);
    for (const double noise : choice.noises) {
      for (const std::string& strength_name : choice.strengths) {
        const Strength strength = parse_strength(strength_name);
        for (const std::string& word : choice.effects) {
          for (int number = 1; number <= choice.trials; ++number) {
            if (word == "pairs") {
              Random random(choice.seed, fmt::format("pair {} {}", kind_name, number));
              add({kind, draw_pair(kind, random), strength, noise, number, choice.seed, choice.arm,
                   choice.size});
              continue;
            }
            for (auto& hidden : hidden_sets(word, kind)) {
              add({kind, std::move(hidden), strength, noise, number, choice.seed, choice.arm,
                   choice.size});
            }
          }
        }
      }
    }
  }
  return keys;
}

}  // namespace flexarm::trials
