#include "tests/trials/trial_list.hpp"

#include "arm/input_error.hpp"
#include "tests/trials/dirt.hpp"
#include "tests/trials/rig_case.hpp"

#include <boost/algorithm/string.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

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

/// The dirt leaves something to be seen of the cause, and is not the same.
bool goes_with(const Cause& cause, const Dirt& dirt) {
  const auto is_in = [&](const std::vector<std::string>& names) {
    return std::ranges::find(names, cause.name) != names.end();
  };
  return !is_in(dirt.named_as) && !is_in(dirt.refitted) &&
         !(dirt.changes_sensors && cause.acts_on == ActsOn::sensor);
}

/// "" stands for none.
std::vector<std::string> dirt_names(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const std::string& word : words) {
    if (word == "all") {
      for (const Dirt& dirt : dirts()) names.push_back(dirt.name);
    } else {
      names.push_back(word == "none" ? "" : find_dirt(word).name);
    }
  }
  return names;
}

/// Words for several causes drawn by chance.
struct DrawnSets {
  std::string_view word;
  std::string_view purpose;  ///< of the random numbers
  std::size_t count;
  bool outside;  ///< of the vocabulary
};
constexpr DrawnSets kDrawnSets[] = {{"one", "one", 1, false},
                                    {"pairs", "pair", 2, false},
                                    {"triples", "triple", 3, false},
                                    {"outside-pairs", "outside pair", 2, true}};

/// Causes that this kind of data shows and the dirt leaves to be seen, by chance, each another.
std::vector<std::string> draw_set(const DrawnSets& of, measured::RunKind kind, const Dirt& dirt,
                                  Random& random) {
  std::vector<std::string> names;
  for (const Cause& cause : causes()) {
    if (cause.outside == of.outside && cause.in_pairs && cause.shows_in(kind) &&
        goes_with(cause, dirt)) {
      names.push_back(cause.name);
    }
  }
  std::vector<std::string> drawn;
  while (drawn.size() < of.count) {
    const auto at = names.begin() + static_cast<std::ptrdiff_t>(random.below(names.size()));
    drawn.push_back(*at);
    // The next is counted from behind it.
    std::ranges::rotate(names, at);
    names.erase(names.begin());
  }
  return drawn;
}

std::vector<std::vector<std::string>> hidden_sets(const std::string& word, measured::RunKind kind,
                                                  const Dirt& dirt) {
  if (word == "none") return {{}};
  std::vector<std::vector<std::string>> sets;
  if (word == "single" || word == "outside") {
    for (const Cause& cause : causes()) {
      if (cause.outside == (word == "outside") && cause.shows_in(kind) && goes_with(cause, dirt)) {
        sets.push_back({cause.name});
      }
    }
    return sets;
  }
  std::vector<std::string> together;
  boost::split(together, word, boost::is_any_of("+"));
  const bool all_show = std::ranges::all_of(together, [&](const std::string& name) {
    return find_cause(name).shows_in(kind) && goes_with(find_cause(name), dirt);
  });
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
  const auto add_sets = [&](TrialKey key, const std::string& word) {
    if (word == "rig") {
      if (key.kind != measured::RunKind::time || !key.dirt.empty()) return;
      Random random(key.seed, fmt::format("rig {}", key.number));
      key.hidden = draw_rig_causes(random);
      key.noise = kRigNoise;
      key.rig = true;
      add(key);
      return;
    }
    const Dirt& dirt = find_dirt(key.dirt);
    const auto drawn = std::ranges::find(kDrawnSets, word, &DrawnSets::word);
    if (drawn != std::end(kDrawnSets)) {
      // Other causes under each dirt; those without dirt are drawn by what they always were.
      std::string drawing =
          fmt::format("{} {} {}", drawn->purpose, measured::to_string(key.kind), key.number);
      if (!key.dirt.empty()) drawing += " " + key.dirt;
      Random random(key.seed, drawing);
      key.hidden = draw_set(*drawn, key.kind, dirt, random);
      add(key);
      return;
    }
    for (auto& hidden : hidden_sets(word, key.kind, dirt)) {
      key.hidden = std::move(hidden);
      add(key);
    }
  };
  const std::vector<std::string> with_dirt = dirt_names(choice.dirts);
  for (const std::string& kind_name : choice.kinds) {
    const measured::RunKind kind = parse_kind(kind_name);
    for (const double noise : choice.noises) {
      for (const std::string& strength_name : choice.strengths) {
        const Strength strength = parse_strength(strength_name);
        for (const std::string& dirt : with_dirt) {
          if (!dirt.empty() && kind != measured::RunKind::time) continue;
          for (const std::string& word : choice.effects) {
            for (int number = 1; number <= choice.trials; ++number) {
              add_sets({kind,
                        {},
                        strength,
                        noise,
                        number,
                        choice.seed,
                        choice.arm,
                        choice.size,
                        dirt,
                        choice.dirt_size},
                       word);
            }
          }
        }
      }
    }
  }
  return keys;
}

}  // namespace flexarm::trials
