#include "diagnose/ranked/ranked_selection.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/ranked/ranked_search.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// -2 ln L of the validation runs by a candidate; infinite for one that cannot be computed.
double held_out_cost(const Likelihood& held_out, const Candidate& candidate) {
  const auto residuals = held_out.problem().residuals(candidate, held_out.runs());
  if (!residuals) return std::numeric_limits<double>::infinity();
  return held_out.cost(held_out.lines(*residuals));
}

/// The fit of `best` without each of its effects.
std::vector<RankedFit> without_each(const Likelihood& likelihood, const RankedFit& best,
                                    const ReportedWork& work) {
  std::vector<RankedFit> made(best.candidate.effects.size());
  in_parallel(made.size(), [&](std::size_t i) {
    made[i] = ranked_fit(likelihood, best.candidate.without(i), work);
  });
  return made;
}

/// `best` without the effects that validation runs are predicted better without.
RankedFit held_out_best(const Likelihood& likelihood, RankedFit best, const ReportedWork& work) {
  const Likelihood held_out(likelihood.problem(), likelihood.problem().validation_runs());
  while (!best.candidate.effects.empty()) {
    const double with = held_out_cost(held_out, best.candidate);
    std::vector<RankedFit> without = without_each(likelihood, best, work);
    const auto least = std::ranges::min_element(
        without, {}, [&](const RankedFit& one) { return held_out_cost(held_out, one.candidate); });
    if (!(held_out_cost(held_out, least->candidate) < with)) break;
    best = std::move(*least);
  }
  return best;
}

bool has_validation(const Problem& problem) {
  return std::ranges::count(problem.validation_runs(), true) > 0;
}

/// As the report wants it: with the derivatives of the residuals.
Explanation explained(const Problem& problem, const Candidate& candidate) {
  return explain(problem, fit(problem, candidate, {.most_steps = 0}));
}

void keep(const Problem& problem, const Candidate& candidate, Selection& made) {
  if (candidate.effects.empty()) return;
  auto& sets = made.sets_like(candidate);
  if (find_set(sets, candidate) == sets.end()) sets.push_back(explained(problem, candidate));
}

}  // namespace

PredictedSelection select_by_rank(const SelectionTask& task, const Problem& problem,
                                  const DiagnosisProgress& progress) {
  PredictedSelection made{
      .selection = Selection{problem}, .reason = "ranked search", .simulated = problem};
  Selection& selection = made.selection;
  selection.hypotheses = task.hypotheses.size();
  ReportedWork work(progress, task.options.deadline);
  RankedSets sets = ranked_search(problem, task.hypotheses, {}, work);
  if (!sets.is_complete) selection.end = SearchEnd{"ranked search", {}};
  RankedFit best = std::move(sets.best.front());
  const Likelihood likelihood(problem, problem.estimation_runs());
  if (has_validation(problem)) best = held_out_best(likelihood, std::move(best), work);
  selection.nothing = explained(problem, problem.as_filed());
  selection.chosen =
      best.candidate.effects.empty() ? selection.nothing : explained(problem, best.candidate);
  selection.chosen.fit.converged = best.converged;
  keep(problem, best.candidate, selection);
  for (const RankedFit& one : without_each(likelihood, best, work)) {
    keep(problem, one.candidate, selection);
  }
  for (std::size_t i = 0; i < best.candidate.effects.size(); ++i) {
    const Candidate alone =
        problem.as_filed().with(best.candidate.effects[i], best.candidate.values_of(i));
    keep(problem, ranked_fit(likelihood, alone, work).candidate, selection);
  }
  for (std::size_t i = 1; i < sets.best.size(); ++i) {
    keep(problem, sets.best[i].candidate, selection);
  }
  sort_by_fit(selection.singles);
  sort_by_fit(selection.combinations);
  return made;
}

}  // namespace flexarm::diagnose
