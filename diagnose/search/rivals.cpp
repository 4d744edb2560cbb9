#include "diagnose/search/rivals.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace flexarm::diagnose {

bool is_rival(const Candidate& one, const Candidate& other) {
  const auto shared = std::ranges::count_if(
      one.effects, [&](const Hypothesis& effect) { return other.has(effect); });
  return one.effects.size() == other.effects.size() && shared + 1 == std::ssize(one.effects);
}

bool is_limit(const Candidate& one, const Candidate& other) {
  if (!is_rival(one, other)) return false;
  const auto own_of = [](const Candidate& set, const Candidate& beside) {
    return *std::ranges::find_if(set.effects,
                                 [&](const Hypothesis& effect) { return !beside.has(effect); });
  };
  return own_of(other, one).contains(own_of(one, other).effect);
}

std::vector<Rival> rivals_of(const Hypothesis& cause, const Selection& selection,
                             const Posterior& posterior) {
  std::vector<Rival> found;
  const Candidate& chosen = selection.chosen.fit.candidate;
  for (const auto* sets : {&selection.singles, &selection.combinations}) {
    for (const Explanation& set : *sets) {
      const Candidate& other = set.fit.candidate;
      if (other.has(cause) || !is_rival(other, chosen)) continue;
      const auto own = std::ranges::find_if(
          other.effects, [&](const Hypothesis& effect) { return !chosen.has(effect); });
      if (own->contains(cause.effect)) continue;
      const double probability = posterior.of_set(other);
      const double odds = probability > 0.0 ? posterior.of_set(chosen) / probability
                                            : std::numeric_limits<double>::infinity();
      found.push_back({&*own, odds, lead(selection.chosen, set)});
    }
  }
  std::ranges::stable_sort(found, {}, &Rival::odds);
  return found;
}

std::vector<Explanation> indistinguishable_sets(const Selection& selection,
                                                const Posterior& posterior) {
  std::vector<Explanation> found;
  const Candidate& chosen = selection.chosen.fit.candidate;
  for (const auto* sets : {&selection.singles, &selection.combinations}) {
    for (const Explanation& set : *sets) {
      if (is_rival(set.fit.candidate, chosen) &&
          posterior.of_set(chosen) <=
              selection.problem.policy().odds * posterior.of_set(set.fit.candidate)) {
        found.push_back(set);
      }
    }
  }
  sort_by_fit(found);
  return found;
}

Posterior posterior_of(const Selection& selection) {
  std::vector<const Explanation*> sets = {&selection.nothing};
  const auto add = [&sets](const Explanation& explanation) {
    const bool is_new = std::ranges::none_of(sets, [&](const Explanation* set) {
      return set->fit.candidate.labels() == explanation.fit.candidate.labels();
    });
    if (is_new) sets.push_back(&explanation);
  };
  add(selection.chosen);
  for (const auto* found : {&selection.singles, &selection.combinations}) {
    std::ranges::for_each(*found, add);
  }
  return Posterior(sets);
}

double class_probability(const Hypothesis& cause, const std::vector<Rival>& rivals,
                         const Posterior& posterior, double most_odds) {
  std::vector<const Hypothesis*> indistinguishable;
  for (const Rival& rival : rivals) {
    const bool is_far_better = rival.odds * most_odds < 1.0;
    if (rival.odds <= most_odds && !is_far_better) {
      indistinguishable.push_back(rival.effect);
    }
  }
  return posterior.of_any(cause, indistinguishable);
}

}  // namespace flexarm::diagnose
