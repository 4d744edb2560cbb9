#include "diagnose/ranked/ranked_selection.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/ranked/evidence_of_fit.hpp"
#include "diagnose/ranked/ranked_search.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// A set whose score is higher by this or more has a probability below 1 %: its parameters are not
/// reported.
constexpr double kReported = 9.0;

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
    made[i] =
        ranked_fit(likelihood, best.candidate.without(i), work, {.takes_secants = true}, &best);
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
    best = ranked_fit(likelihood,
                      without[static_cast<std::size_t>(least - costs.begin())].candidate, work);
    cost = held_out_cost(held_out, best.candidate);
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
    without = drop_by_validation(likelihood, best, work);
    made.evidence = evidence_for_each(likelihood, best, without, work);
  } catch (const Cancelled&) {
    if (!work.is_out_of_time()) throw;
    made.end = SearchEnd{kStage, {}};
  }
  work.lift_deadline();
  const RankedFit filed = ranked_fit(likelihood, problem.as_filed(), work);
  made.nothing = explained(problem, filed, true);
  made.chosen = best.candidate.effects.empty() ? made.nothing : explained(problem, best, true);
  const auto keep = [&](const RankedFit& one) {
    if (one.candidate.effects.empty()) return;
    auto& kept = made.sets_like(one.candidate);
    if (find_set(kept, one.candidate) != kept.end()) return;
    kept.push_back(explained(problem, one, one.score < best.score + kReported));
  };
  for (const RankedFit& one : sets.best) keep(one);
  for (const RankedFit& one : without) {
    keep(one);
    made.without.push_back(explained(problem, one, false));
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
