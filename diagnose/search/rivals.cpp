#include "diagnose/search/rivals.hpp"

#include "diagnose/search/admission.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace flexarm::diagnose {

bool is_rival(const Candidate& one, const Candidate& other) {
  const auto shared = std::ranges::count_if(
      one.effects, [&](const Hypothesis& effect) { return other.has(effect); });
  return one.effects.size() == other.effects.size() && shared + 1 == std::ssize(one.effects);
}

bool has_limit_in_place(const Candidate& limited, const Candidate& general) {
  if (!is_rival(limited, general)) return false;
  const auto own = std::ranges::find_if_not(
      general.effects, [&](const Hypothesis& effect) { return limited.has(effect); });
  return std::ranges::any_of(limited.effects, [&](const Hypothesis& effect) {
    return !general.has(effect) && own->contains(effect.effect);
  });
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
              kIndistinguishableOdds * posterior.of_set(set.fit.candidate)) {
        found.push_back(set);
      }
    }
  }
  sort_by_fit(found);
  return found;
}

Posterior posterior_of(const Selection& selection, const SelectionOptions& options) {
  std::vector<const Explanation*> sets = {&selection.nothing};
  const auto is_new = [&sets](const Explanation& explanation) {
    return std::ranges::none_of(sets, [&](const Explanation* set) {
      return set->fit.candidate.labels() == explanation.fit.candidate.labels();
    });
  };
  const auto is_inconsistent = [&](const Explanation& explanation) {
    return !explanation.leaves_noise() &&
           std::ranges::any_of(selection.inconsistent, [&](const RunDrift& drift) {
             return explanation.fit.candidate.has_effect(drift.effect);
           });
  };
  const Explanation& chosen = selection.chosen;
  const auto adds_nothing = [&](const Explanation& explanation) {
    return chosen.leaves_noise() &&
           has_limit_in_place(chosen.fit.candidate, explanation.fit.candidate) &&
           !clears_bars(explanation, chosen, options);
  };
  const auto is_left_out = [&](const Explanation& explanation) {
    return is_inconsistent(explanation) || adds_nothing(explanation) || !is_identified(explanation);
  };
  if (is_new(chosen)) sets.push_back(&chosen);
  for (const auto* found : {&selection.singles, &selection.combinations}) {
    for (const Explanation& explanation : *found) {
      if (!chosen.score && is_left_out(explanation)) continue;
      if (is_new(explanation)) sets.push_back(&explanation);
    }
  }
  if (chosen.score) return Posterior(sets);
  return {sets, selection.hypotheses, options};
}

std::optional<std::size_t> improbable_effect(const Selection& selection,
                                             const SelectionOptions& options) {
  const Candidate& candidate = selection.chosen.fit.candidate;
  const Posterior posterior = posterior_of(selection, options);
  double least = options.least_probability;
  std::optional<std::size_t> improbable;
  for (std::size_t i = 0; i < candidate.effects.size(); ++i) {
    const Hypothesis& effect = candidate.effects[i];
    const double probability =
        class_probability(effect, rivals_of(effect, selection, posterior), posterior);
    if (probability >= least) continue;
    least = probability;
    improbable = i;
  }
  return improbable;
}

double class_probability(const Hypothesis& cause, const std::vector<Rival>& rivals,
                         const Posterior& posterior) {
  std::vector<const Hypothesis*> indistinguishable;
  for (const Rival& rival : rivals) {
    const bool is_far_better = rival.odds * kIndistinguishableOdds < 1.0;
    if (rival.odds <= kIndistinguishableOdds && !is_far_better) {
      indistinguishable.push_back(rival.effect);
    }
  }
  return posterior.of_any(cause, indistinguishable);
}

}  // namespace flexarm::diagnose
