#include "diagnose/ranked/ranked_selection.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/ranked/evidence_of_fit.hpp"
#include "diagnose/ranked/ranked_search.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// A set whose score is higher by this or more has a probability below 1 %: its parameters are not
/// reported.
constexpr double kReported = 9.0;

/// Returns the fit of `best` without each of its effects.
std::vector<RankedFit> without_each(const Likelihood& likelihood, const RankedFit& best,
                                    const ReportedWork& work) {
  std::vector<RankedFit> made(best.candidate.effects.size());
  in_parallel(made.size(), [&](std::size_t i) {
    made[i] =
        ranked_fit(likelihood, best.candidate.without(i), work, {.takes_secants = true}, &best);
  });
  return made;
}

/// Drops the effects that validation runs are predicted better without. Returns the fits of the
/// rest without each of its effects.
std::vector<RankedFit> drop_by_validation(const Likelihood& likelihood, const Likelihood& held_out,
                                          RankedFit& best, const ReportedWork& work) {
  double cost = held_out.cost_of(best.candidate);
  while (true) {
    std::vector<RankedFit> without = without_each(likelihood, best, work);
    if (without.empty() || !likelihood.problem().has_validation_runs()) return without;
    std::vector<double> costs;
    for (const RankedFit& one : without) costs.push_back(held_out.cost_of(one.candidate));
    const auto least = std::ranges::min_element(costs);
    if (!(*least < cost)) return without;
    best = ranked_fit(likelihood,
                      without[static_cast<std::size_t>(least - costs.begin())].candidate, work);
    cost = held_out.cost_of(best.candidate);
  }
}

/// Returns a fit as the report wants it; with the derivatives of the residuals, or without.
Explanation explained(const Problem& problem, const RankedFit& made, bool has_derivatives) {
  Explanation explanation = explain(
      problem,
      fit(problem, made.candidate, {.most_steps = 0, .is_differenced_at_end = has_derivatives}));
  explanation.score = made.score;
  explanation.fit.converged = made.converged;
  return explanation;
}

/// Throws Cancelled where the work is cancelled, but not after its deadline.
void search(const Problem& problem, const std::vector<Hypothesis>& hypotheses, ReportedWork& work,
            Selection& made) {
  constexpr const char* kStage = "ranked search";
  const Likelihood likelihood(problem, problem.estimation_runs());
  RankedSets sets = ranked_search(likelihood, hypotheses, {}, work);
  if (!sets.is_complete) made.end = SearchEnd{kStage, {}};
  RankedFit& best = sets.best.front();
  std::vector<RankedFit> without;
  try {
    const Likelihood held_out(problem, problem.validation_runs());
    without = drop_by_validation(likelihood, held_out, best, work);
    made.evidence = evidence_for_each(held_out, best, without, work);
  } catch (const Cancelled&) {
    if (!work.is_out_of_time()) throw;
    made.end = SearchEnd{kStage, {}};
  }
  work.lift_deadline();
  const RankedFit filed = ranked_fit(likelihood, problem.as_filed(), work);
  made.nothing = explained(problem, filed, true);
  made.chosen = best.candidate.effects.empty() ? made.nothing : explained(problem, best, true);
  const auto explained_near = [&](const RankedFit& one) {
    return explained(problem, one, one.score < best.score + kReported);
  };
  const auto is_kept = [&](const Candidate& set) {
    auto& kept = made.sets_like(set);
    return set.effects.empty() || find_set(kept, set) != kept.end();
  };
  for (const RankedFit& one : sets.best) {
    if (is_kept(one.candidate)) continue;
    made.sets_like(one.candidate).push_back(explained_near(one));
  }
  for (const RankedFit& one : without) {
    made.without.push_back(explained_near(one));
    if (is_kept(one.candidate)) continue;
    made.sets_like(one.candidate).push_back(made.without.back());
  }
  sort_by_fit(made.singles);
  sort_by_fit(made.combinations);
}

}  // namespace

Selection ranked_selection(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                           const SelectionOptions& options, const DiagnosisProgress& progress) {
  Selection made{problem};
  made.hypotheses = hypotheses.size();
  ReportedWork work(progress, options.deadline);
  try {
    search(problem, hypotheses, work, made);
  } catch (const Cancelled&) {
    made.cancelled = true;
  }
  return made;
}

}  // namespace flexarm::diagnose
