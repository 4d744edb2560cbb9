#include "diagnose/ranked/ranked_selection.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/ranked/ranked_search.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// Returns -2 ln L of the validation runs by a candidate; infinite for one that cannot be computed.
double held_out_cost(const Likelihood& held_out, const Candidate& candidate) {
  const auto lines = held_out.lines_of(candidate);
  return lines ? held_out.cost(*lines) : std::numeric_limits<double>::infinity();
}

/// Returns the fit of `best` without each of its effects.
std::vector<RankedFit> without_each(const Likelihood& likelihood, const RankedFit& best,
                                    const ReportedWork& work) {
  std::vector<RankedFit> made(best.candidate.effects.size());
  in_parallel(made.size(), [&](std::size_t i) {
    made[i] = ranked_fit(likelihood, best.candidate.without(i), work);
  });
  return made;
}

/// Drops the effects that validation runs are predicted better without. Returns the fits of the
/// rest without each of its effects.
std::vector<RankedFit> drop_by_validation(const Likelihood& likelihood, RankedFit& best,
                                          const ReportedWork& work) {
  const Likelihood held_out(likelihood.problem(), likelihood.problem().validation_runs());
  double cost = held_out_cost(held_out, best.candidate);
  while (true) {
    std::vector<RankedFit> without = without_each(likelihood, best, work);
    if (without.empty() || !likelihood.problem().has_validation_runs()) return without;
    std::vector<double> costs;
    for (const RankedFit& one : without) {
      costs.push_back(held_out_cost(held_out, one.candidate));
    }
    const auto least = std::ranges::min_element(costs);
    if (!(*least < cost)) return without;
    cost = *least;
    best = std::move(without[static_cast<std::size_t>(least - costs.begin())]);
  }
}

/// Returns a candidate as the report wants it: with the derivatives of the residuals.
Explanation explained(const Problem& problem, const Candidate& candidate) {
  return explain(problem, fit(problem, candidate, {.most_steps = 0}));
}

void keep(const Problem& problem, const Candidate& candidate, Selection& made) {
  if (candidate.effects.empty()) return;
  auto& sets = made.sets_like(candidate);
  if (find_set(sets, candidate) == sets.end()) sets.push_back(explained(problem, candidate));
}

/// Throws Cancelled where the work is cancelled, but not after its deadline.
void search(const Problem& problem, const std::vector<Hypothesis>& hypotheses, ReportedWork& work,
            Selection& made) {
  constexpr const char* kStage = "ranked search";
  const Likelihood likelihood(problem, problem.estimation_runs());
  RankedSets sets = ranked_search(likelihood, hypotheses, {}, work);
  if (!sets.is_complete) made.end = SearchEnd{kStage, {}};
  RankedFit& best = sets.best.front();
  std::vector<RankedFit> others;
  try {
    others = drop_by_validation(likelihood, best, work);
    for (std::size_t i = 0; i < best.candidate.effects.size(); ++i) {
      const Candidate alone =
          problem.as_filed().with(best.candidate.effects[i], best.candidate.values_of(i));
      others.push_back(ranked_fit(likelihood, alone, work));
    }
  } catch (const Cancelled&) {
    if (!work.is_out_of_time()) throw;
    made.end = SearchEnd{kStage, {}};
  }
  made.nothing = explained(problem, problem.as_filed());
  made.chosen = best.candidate.effects.empty() ? made.nothing : explained(problem, best.candidate);
  made.chosen.fit.converged = best.converged;
  std::ranges::move(sets.best, std::back_inserter(others));
  for (const RankedFit& one : others) keep(problem, one.candidate, made);
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
