#include "diagnose/search/selection.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/dependence.hpp"
#include "diagnose/search/evidence_of_fit.hpp"
#include "diagnose/search/nuisances.hpp"
#include "diagnose/search/residual_test.hpp"
#include "diagnose/search/rivals.hpp"
#include "diagnose/search/set_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// A set whose score is higher by this or more has a probability below 1 %: its parameters are not
/// reported (posterior_sets.hpp).
constexpr double kReported = 9.0;

/// Returns the fit of `best` without each of its effects.
std::vector<ScoredFit> without_each(const Likelihood& likelihood, const ScoredFit& best,
                                    const ReportedWork& work) {
  std::vector<ScoredFit> made(best.candidate.effects.size());
  in_parallel(made.size(), [&](std::size_t i) {
    made[i] =
        scored_fit(likelihood, best.candidate.without(i), work, {.takes_secants = true}, &best);
  });
  return made;
}

/// A fitted set and the fits without each of its effects.
struct SetWithoutEach {
  ScoredFit set;
  std::vector<ScoredFit> without;
};

/// Returns the best of `sets`, which are in order, made simpler. An effect gives place to a limit
/// of it, in a set that was fitted, at posterior odds of Policy::odds or less against that, and is
/// dropped where the set without it has a score that is higher by Policy::bare_mention or less.
/// Where the best set leaves noise so does the simpler one.
SetWithoutEach simplest_of(const Likelihood& likelihood, const std::vector<ScoredFit>& sets,
                           const ReportedWork& work) {
  ScoredFit simplest = sets.front();
  const Policy& policy = likelihood.problem().policy();
  const double highest = simplest.score + 2.0 * std::log(policy.odds);
  const bool leaves_noise = likelihood.is_noise(simplest.lines);
  const auto does_as_well = [&](const ScoredFit& one, double most) {
    return one.score <= most && (!leaves_noise || likelihood.is_noise(one.lines));
  };
  for (const ScoredFit& other : sets) {
    if (!is_limit(other.candidate, simplest.candidate) || !does_as_well(other, highest)) continue;
    simplest = scored_fit(likelihood, other.candidate, work);
  }
  while (true) {
    std::vector<ScoredFit> without = without_each(likelihood, simplest, work);
    const double most = simplest.score + policy.bare_mention;
    const auto score = [&](const ScoredFit& one) {
      return does_as_well(one, most) ? one.score : std::numeric_limits<double>::infinity();
    };
    const auto weakest = std::ranges::min_element(without, {}, score);
    if (weakest == without.end() || !does_as_well(*weakest, most)) return {simplest, without};
    simplest = scored_fit(likelihood, weakest->candidate, work);
  }
}

/// Drops the effects that validation runs are predicted better without.
void drop_by_validation(const Likelihood& likelihood, const Likelihood& held_out,
                        SetWithoutEach& best, const ReportedWork& work) {
  if (!likelihood.problem().has_validation_runs()) return;
  while (!best.without.empty()) {
    std::vector<double> costs;
    for (const ScoredFit& one : best.without) costs.push_back(held_out.cost_of(one.candidate));
    const auto least = std::ranges::min_element(costs);
    // Fits end this far from their minima: runs that do not show an effect tell nothing against it.
    const double margin = 2.0 * MinimiseOptions{}.tolerance;
    if (!(*least < held_out.cost_of(best.set.candidate) - margin)) return;
    const auto weakest = static_cast<std::size_t>(least - costs.begin());
    best.set = scored_fit(likelihood, best.without[weakest].candidate, work);
    best.without = without_each(likelihood, best.set, work);
  }
}

/// Returns a fit as the report wants it; with the derivatives of the residuals, or without.
Explanation explained(const Problem& problem, const ScoredFit& made, bool has_derivatives) {
  Explanation explanation =
      explain(problem, has_derivatives ? fit(problem, made.candidate, {.most_steps = 0})
                                       : evaluated(problem, made.candidate));
  explanation.score = made.score;
  explanation.fit.converged = made.converged;
  return explanation;
}

/// Returns the sets of a problem whose noise is as the best of them shows it: where the data alone
/// show a higher level, at which a search ended too early, it is made again.
FoundSets search(Problem& problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, ReportedWork& work) {
  SearchBounds bounds{.starts = options.starts};
  if (options.most_causes) bounds.most_effects = static_cast<std::size_t>(*options.most_causes);
  const Likelihood likelihood(problem, problem.estimation_runs());
  FoundSets sets = search_sets(likelihood, hypotheses, bounds, work);
  const ScoredFit& best = sets.best.front();
  if (!sets.is_complete || !best.is_possible() || !likelihood.is_noise(best.lines)) return sets;
  Problem lowered = problem;
  if (!lowered.lower_noise(best.candidate)) return sets;
  const Likelihood in_lower_noise(lowered, lowered.estimation_runs());
  const auto lines = in_lower_noise.lines_of(best.candidate);
  if (!lines || in_lower_noise.is_noise(*lines)) return sets;
  problem = lowered;
  return search_sets(in_lower_noise, hypotheses, bounds, work);
}

/// Returns the set without its effects on timing, which a jitter of the torque looks like.
Candidate without_timing(Candidate set) {
  for (std::size_t i = set.effects.size(); i-- > 0;) {
    if (set.effects[i].entry->family == effects::Family::timing) set = set.without(i);
  }
  return set;
}

/// Searches again with corrected torques, where their timing explains much of what the first search
/// leaves; the sets of both are `made`'s where that leaves noise.
void search_with_timing(Selection& made, FoundSets& sets, const std::vector<Hypothesis>& hypotheses,
                        const SelectionOptions& options, ReportedWork& work) {
  const Candidate& best = sets.best.front().candidate;
  const Candidate untimed = without_timing(best);
  auto timed = with_timing(made.problem, untimed, options);
  const bool has_timing = untimed.effects.size() < best.effects.size();
  if (!timed && has_timing) timed = with_timing(made.problem, best, options);
  if (!timed) return;
  FoundSets again = search(timed->problem, hypotheses, options, work);
  const Candidate& found = again.best.front().candidate;
  Problem lowered = timed->problem;
  lowered.lower_noise(found);
  if (explain(lowered, evaluated(lowered, found)).leaves_noise()) {
    made.problem = timed->problem;
    made.timing = std::move(timed->timing);
    sets = std::move(again);
  } else {
    made.undecided_timing = std::move(timed->timing);
  }
}

/// Takes up the noise that the data show beside the best set, white or coloured. Where the arm as
/// filed leaves noise of some colour, that is the best set. Effects that are not needed beside
/// coloured noise are dropped. The fits are of `likelihood`, in white noise.
void see_noise(const Likelihood& likelihood, Problem& problem, SetWithoutEach& best,
               const ScoredFit& filed, ReportedWork& work) {
  const Candidate& set = best.set.candidate;
  const auto& noise = problem.predictor().noise();
  if (noise && !noise->is_torque_noise()) {
    problem.estimate_noise(set, [&work] { work.go_on(); });
    return;
  }
  problem.lower_noise(set);
  if (auto coloured = with_noise_colour(problem, filed.candidate, kResidualLevel, work)) {
    problem = *std::move(coloured);
    best = {filed, {}};
  } else if (!set.effects.empty()) {
    coloured = with_noise_colour(problem, set, kResidualLevel, work);
    if (!coloured) return;
    problem = *std::move(coloured);
    const Likelihood beside_noise =
        Likelihood(problem, problem.estimation_runs()).with(SampleSize::of_noise);
    const Candidate kept =
        simplest_of(beside_noise, {scored_fit(beside_noise, set, work)}, work).set.candidate;
    if (kept.effects.size() < set.effects.size()) {
      best.set = scored_fit(likelihood, kept, work);
      best.without = without_each(likelihood, best.set, work);
    }
  }
}

/// Takes the arm as filed for the result, at the level of noise that it shows. Returns whether it
/// leaves noise: there is nothing to search for.
bool is_adequate(Selection& made) {
  Problem lowered = made.problem;
  const Candidate filed = lowered.as_filed();
  lowered.lower_noise(filed);
  made.nothing = explain(lowered, fit(lowered, filed, {.most_steps = 0}));
  made.chosen = made.nothing;
  made.problem = lowered.until({});
  return made.nothing.leaves_noise();
}

/// Returns the labels of the effects that a set has not.
std::vector<std::string> labels_beside(const ScoredFit& set,
                                       const std::vector<Hypothesis>& hypotheses) {
  const std::set<std::string> own = set.candidate.labels();
  std::vector<std::string> made;
  for (const Hypothesis& one : hypotheses) {
    if (!own.contains(one.label())) made.push_back(one.label());
  }
  return made;
}

/// Keeps what was fitted: `sets`, the best first, and the best without each of its effects.
void keep_sets(Selection& made, const std::vector<ScoredFit>& sets,
               const std::vector<ScoredFit>& without) {
  const auto explained_near = [&](const ScoredFit& one) {
    return explained(made.problem, one, one.score < sets.front().score + kReported);
  };
  const auto is_kept = [&](const Candidate& set) {
    auto& kept = made.sets_like(set);
    return set.effects.empty() || find_set(kept, set) != kept.end();
  };
  for (const ScoredFit& one : sets) {
    if (is_kept(one.candidate)) continue;
    made.sets_like(one.candidate).push_back(explained_near(one));
  }
  for (const ScoredFit& one : without) {
    made.without.push_back(explained_near(one));
    if (is_kept(one.candidate)) continue;
    made.sets_like(one.candidate).push_back(made.without.back());
  }
  sort_by_fit(made.singles);
  sort_by_fit(made.combinations);
}

/// Selects effects for `made`, of which the problem is given. After the deadline of the work that
/// is the best so far. Throws Cancelled where the work is cancelled otherwise, and where not even
/// the arm as filed was simulated by options.last.
void select(const std::vector<Hypothesis>& hypotheses, const SelectionOptions& options,
            ReportedWork& work, Selection& made) {
  constexpr const char* kStage = "search";
  const Problem recorded = made.problem;
  made.problem = recorded.until(options.last);
  if (is_adequate(made)) return;
  const Problem of_filed = made.problem;
  made.problem = recorded.until(options.deadline);
  FoundSets sets;
  ScoredFit filed;
  const auto in_time = [&](const auto& step) {
    try {
      step();
    } catch (const Cancelled&) {
      if (!work.is_out_of_time()) throw;
      if (!made.end) made.end = SearchEnd{kStage, {}};
    }
  };
  in_time([&] {
    sets = search(made.problem, hypotheses, options, work);
    if (sets.is_complete) search_with_timing(made, sets, hypotheses, options, work);
  });
  if (sets.best.empty()) {
    sets.best.push_back({{.candidate = made.problem.as_filed()}});
    sets.is_complete = false;
  }
  SetWithoutEach found{sets.best.front(), {}};
  if (!sets.is_complete) made.end = SearchEnd{kStage, labels_beside(found.set, hypotheses)};
  in_time([&] {
    const Problem searched = made.problem;
    const Likelihood likelihood =
        Likelihood(searched, searched.estimation_runs()).with(sets.sample_size);
    filed = scored_fit(likelihood, searched.as_filed(), work);
    found = simplest_of(likelihood, sets.best, work);
    see_noise(likelihood, made.problem, found, filed, work);
    const Likelihood held_out =
        Likelihood(searched, searched.validation_runs()).with(sets.sample_size);
    drop_by_validation(likelihood, held_out, found, work);
    const Candidate& set = found.set.candidate;
    if (set.effects.empty()) {
      // Nothing was found that the residuals depend on.
      auto coloured = with_noise_colour(made.problem, set, kCertainDependence, work);
      if (coloured) made.problem = *std::move(coloured);
    }
    made.evidence = evidence_for_each(held_out, found.set, found.without, work);
  });
  work.lift_deadline();
  const auto& [best, without] = found;
  if (!filed.is_possible() && best.candidate.effects.empty()) {
    made.problem = of_filed;
    return;
  }
  made.problem = made.problem.until({});
  if (!filed.is_possible()) {
    const Likelihood likelihood =
        Likelihood(made.problem, made.problem.estimation_runs()).with(sets.sample_size);
    filed = scored_fit(likelihood, made.problem.as_filed(), work);
  }
  const Problem& problem = made.problem;
  made.nothing = explained(problem, filed, true);
  made.chosen = best.candidate.effects.empty() ? made.nothing : explained(problem, best, true);
  if (made.chosen.leaves_noise() && !best.candidate.effects.empty()) {
    // Least squares are more exact than the likelihood of the search, which estimates the noise.
    made.chosen = explain(problem, fit(problem, best.candidate, {.work = &work}));
    made.chosen.score = best.score;
  }
  // After the deadline: each set that is kept costs simulations of all data.
  if (made.end && made.evidence.empty()) {
    sets.best.clear();
    found.without.clear();
  }
  sets.best.insert(sets.best.begin(), best);
  keep_sets(made, sets.best, without);
  made.rivals = indistinguishable_sets(made, posterior_of(made));
}

}  // namespace

Selection select(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, const DiagnosisProgress& progress) {
  Selection made{problem};
  made.hypotheses = hypotheses.size();
  ReportedWork work(progress, options.deadline);
  try {
    select(hypotheses, options, work, made);
  } catch (const Cancelled&) {
    require_time(options.last);
    made.cancelled = true;
  }
  return made;
}

}  // namespace flexarm::diagnose
