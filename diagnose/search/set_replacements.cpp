#include "diagnose/search/set_replacements.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/admission.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::diagnose {

Explanation SetReplacements::replaced(Selection& made, const Candidate& candidate,
                                      std::size_t index, const Hypothesis& other) const {
  if (auto known = fitted_before(made, candidate, index, other)) return *std::move(known);
  return fitted_and_kept(made, fits_.scan().look_in_place(candidate, index, other));
}

std::optional<Explanation> SetReplacements::replaced_near_noise(Selection& made,
                                                                const Candidate& candidate,
                                                                std::size_t index,
                                                                const Hypothesis& other) const {
  if (auto known = fitted_before(made, candidate, index, other)) return known;
  const EffectScan& scan = fits_.scan();
  const bool is_far_early = fits_.parts().is_early_shorter() &&
                            !is_near_noise(scan.early_look(candidate.without(index), other));
  if (is_far_early) return std::nullopt;
  const Fit look = scan.look_in_place(candidate, index, other);
  if (!is_near_noise(look)) return std::nullopt;
  return fitted_and_kept(made, look);
}

std::optional<Explanation> SetReplacements::fitted_before(Selection& made,
                                                          const Candidate& candidate,
                                                          std::size_t index,
                                                          const Hypothesis& other) {
  auto& kept = made.sets_like(candidate);
  const auto same = find_set(kept, candidate.without(index).with(other, other.middle()));
  return same != kept.end() ? std::optional(*same) : std::nullopt;
}

Explanation SetReplacements::fitted_and_kept(Selection& made, const Fit& look) const {
  Explanation found = fits_.fitted(look.candidate);
  auto& kept = made.sets_like(look.candidate);
  kept.push_back(found);
  sort_by_fit(kept);
  return found;
}

Explanation SetReplacements::without(Selection& made, const Candidate& candidate,
                                     std::size_t index) const {
  const Candidate rest = candidate.without(index);
  auto& kept = made.sets_like(rest);
  const auto same = find_set(kept, rest);
  if (!made.end) return fits_.fitted(rest);
  return same != kept.end() ? *same : made.nothing;
}

bool SetReplacements::clears_limits(Selection& made, const Explanation& fuller) const {
  const std::vector<LimitOfEffect> limits = limits_in(fuller.fit.candidate, hypotheses_);
  if (limits.empty()) return true;
  const Explanation kept = fuller;
  return std::ranges::all_of(limits, [&](const LimitOfEffect& of) {
    return clears_bars(kept, replaced(made, kept.fit.candidate, of.effect, *of.limit), options_);
  });
}

Explanation SetReplacements::specialised(Selection& made, Explanation found) const {
  for (const LimitOfEffect& of : limits_in(found.fit.candidate, hypotheses_)) {
    const Explanation limited = replaced(made, found.fit.candidate, of.effect, *of.limit);
    if (!clears_bars(found, limited, options_)) return specialised(made, limited);
  }
  return found;
}

Explanation SetReplacements::generalised(Selection& made, Explanation best) const {
  const Candidate candidate = best.fit.candidate;
  for (std::size_t i = 0; i < candidate.effects.size(); ++i) {
    for (const Hypothesis* general : general_.with_limit(candidate.effects[i])) {
      if (candidate.has_effect(general->effect)) continue;
      Explanation found = replaced(made, candidate, i, *general);
      const bool is_better = found.fit.sum_of_squares < best.fit.sum_of_squares;
      if (is_better && is_identified(found)) return generalised(made, std::move(found));
    }
  }
  return best;
}

Explanation SetReplacements::needed(const Explanation& explanation) const {
  const Candidate& candidate = explanation.fit.candidate;
  if (candidate.effects.size() < 2) return explanation;
  std::vector<Explanation> simpler(candidate.effects.size());
  in_parallel(simpler.size(),
              [&](std::size_t i) { simpler[i] = fits_.fitted(candidate.without(i)); });
  sort_by_fit(simpler);
  for (const Explanation& one : simpler) {
    if (!clears_bars(explanation, one, options_)) return needed(one);
  }
  return explanation;
}

}  // namespace flexarm::diagnose
