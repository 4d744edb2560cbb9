#include "diagnose/planning/next_experiments.hpp"

#include "arm/input_error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// As in fit.cpp: beside the rounding of a simulation and its curvature, both small.
constexpr double kPlanStep = 1e-5;
/// A run is worth adding where the score rises by so many ties.
constexpr double kWorthAdding = 0.1;
/// Rivals that are looked at after a diagnosis: the nearest.
constexpr std::size_t kMostRivals = 3;

using Informations = std::vector<Eigen::MatrixXd>;  // one a run

/// All that a fit of the candidate moves.
std::size_t fitted_parameters(const Candidate& candidate) {
  return static_cast<std::size_t>(candidate.coordinates().size());
}

std::vector<PlannedRun> runs_of(const std::vector<FurtherRun>& further) {
  std::vector<PlannedRun> runs;
  for (const FurtherRun& entry : further) runs.push_back(entry.run);
  return runs;
}

/// What these runs would say of a tie. Throws InputError where an arm cannot be computed.
void observe_tie(const PlannedExperiment& planned, const Tie& tie, const std::vector<bool>& runs,
                 const ReportedWork& work, Informations& made) {
  const Predictor& predict = planned.as_described().predictor();
  const arm::Arm& arm = planned.experiment().arm;
  const Observations data = planned.observations(predict(tie.truth.extend(arm), runs));
  const auto residuals_of = [&](const Candidate& candidate) -> Eigen::VectorXd {
    work.go_on();
    return (data.values - predict(candidate.extend(arm), runs)).cwiseQuotient(data.deviations);
  };
  const Eigen::VectorXd places = tie.rival.coordinates();
  const Eigen::VectorXd residuals = residuals_of(tie.rival);
  Eigen::MatrixXd jacobian(residuals.size(), places.size());
  for (Index i = 0; i < places.size(); ++i) {
    Eigen::VectorXd beside = places;
    const double step = places(i) < 0.5 ? kPlanStep : -kPlanStep;
    beside(i) += step;
    Candidate moved = tie.rival;
    moved.put(beside);
    jacobian.col(i) = (residuals_of(moved) - residuals) / step;
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r]) continue;
    const Index first = data.first_of_run[r];
    const Index count = data.first_of_run[r + 1] - first;
    const Eigen::MatrixXd part =
        information_of(jacobian.middleRows(first, count), residuals.segment(first, count));
    if (part.allFinite()) made[r] = part;
  }
}

/// Each run's information on a tie; zero where it cannot be computed.
Informations informations(const PlannedExperiment& planned, const Tie& tie,
                          const ReportedWork& work) {
  const std::size_t count = planned.experiment().runs.size();
  const Index size = tie.rival.coordinates().size() + 1;
  Informations made(count, Eigen::MatrixXd::Zero(size, size));
  try {
    observe_tie(planned, tie, std::vector<bool>(count, true), work, made);
  } catch (const arm::InputError&) {
    for (std::size_t r = 0; r < count; ++r) {
      std::vector<bool> alone(count, false);
      alone[r] = true;
      try {
        observe_tie(planned, tie, alone, work, made);
      } catch (const arm::InputError&) {
        continue;
      }
    }
  }
  return made;
}

/// What all further runs say of all ties: [tie][run].
struct Evidence {
  std::vector<Informations> of;
  std::vector<double> counts;  ///< numbers in each run
};

Evidence evidence_of(const arm::Arm& arm, const std::vector<FurtherRun>& further,
                     const std::vector<Tie>& ties, ReportedWork& work, double from, double to) {
  const PlannedExperiment planned(arm, runs_of(further));
  Evidence made;
  const auto& first = planned.as_described().observations().first_of_run;
  for (std::size_t r = 0; r < further.size(); ++r) {
    made.counts.push_back(static_cast<double>(first[r + 1] - first[r]));
  }
  made.of.resize(ties.size());
  work.in_parallel(ties.size(), "additional runs", from, to,
                   [&](std::size_t t) { made.of[t] = informations(planned, ties[t], work); });
  return made;
}

double soft_count(double lead) {
  return std::max(0.0, lead) / (std::max(0.0, lead) + kToldLead);
}

std::vector<NextExperiment> rank(const std::vector<FurtherRun>& further,
                                 const std::vector<Tie>& ties, const Evidence& evidence) {
  std::vector<NextExperiment> ranked;
  for (std::size_t r = 0; r < further.size(); ++r) {
    NextExperiment next{further[r], {}, 0, 0.0};
    for (std::size_t t = 0; t < ties.size(); ++t) {
      const double lead =
          expected_lead(ties[t].information + evidence.of[t][r], fitted_parameters(ties[t].truth),
                        ties[t].count + evidence.counts[r]);
      next.leads.push_back(lead);
      if (lead >= kToldLead) ++next.told;
      next.score += soft_count(lead);
    }
    ranked.push_back(std::move(next));
  }
  std::ranges::stable_sort(ranked, std::ranges::greater{}, &NextExperiment::score);
  return ranked;
}

std::vector<NextExperiment> chosen_together(const std::vector<FurtherRun>& further,
                                            std::vector<Tie> ties, const Evidence& evidence,
                                            std::size_t most) {
  std::vector<NextExperiment> chosen;
  double score = 0.0;
  for (const Tie& tie : ties) {
    score += soft_count(expected_lead(tie.information, fitted_parameters(tie.truth), tie.count));
  }
  while (chosen.size() < most) {
    NextExperiment best = rank(further, ties, evidence).front();
    if (best.score < score + kWorthAdding) break;
    score = best.score;
    const auto at = std::ranges::find(further, best.further.run.id,
                                      [](const FurtherRun& entry) { return entry.run.id; });
    const auto r = static_cast<std::size_t>(at - further.begin());
    for (std::size_t t = 0; t < ties.size(); ++t) {
      ties[t].information += evidence.of[t][r];
      ties[t].count += evidence.counts[r];
    }
    chosen.push_back(std::move(best));
  }
  return chosen;
}

Tie tie_between(const Explanation& truth, const Explanation& rival) {
  Tie tie{truth.fit.candidate, rival.fit.candidate, {}, truth.estimation.count};
  // Residuals of the data of the truth: what the two predict differently.
  tie.information = information_of(rival.fit.jacobian, rival.fit.residuals - truth.fit.residuals);
  return tie;
}

/// An effect of the chosen ones contains, as a limit, or is contained in the one that took its
/// place: no experiment is asked for to tell them.
bool is_a_limit(const Candidate& chosen, const Candidate& rival) {
  return std::ranges::any_of(rival.effects, [&](const Hypothesis& effect) {
    return !chosen.has(effect) && std::ranges::any_of(chosen.effects, [&](const auto& cause) {
      return effect.contains(cause.effect);
    });
  });
}

}  // namespace

FurtherRunsWorth worth_of_further_runs(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                                       const std::vector<Tie>& ties, std::size_t most_together,
                                       ReportedWork& work, double from, double to) {
  if (ties.empty()) return {};
  try {
    const auto further = further_runs(arm, runs);
    const Evidence evidence = evidence_of(arm, further, ties, work, from, to);
    return {rank(further, ties, evidence), chosen_together(further, ties, evidence, most_together)};
  } catch (const arm::InputError&) {
    return {};
  }
}

std::vector<NextExperiment> what_next(const Problem& problem, const Selection& selection,
                                      bool is_explained, ReportedWork& work) {
  const bool is_named = !selection.chosen.fit.candidate.effects.empty();
  std::vector<Tie> ties;
  if (is_named) {
    for (const Explanation& rival : selection.rivals) {
      if (is_a_limit(selection.chosen.fit.candidate, rival.fit.candidate)) continue;
      if (ties.size() < kMostRivals) ties.push_back(tie_between(selection.chosen, rival));
    }
  } else if (!is_explained && !selection.singles.empty()) {
    for (std::size_t i = 1; i < std::min(kMostRivals, selection.singles.size()); ++i) {
      ties.push_back(tie_between(selection.singles.front(), selection.singles[i]));
    }
  }
  const std::vector<PlannedRun> measured = planned_as_measured(problem);
  auto ranked =
      worth_of_further_runs(problem.experiment().arm, measured, ties, 0, work, 1.0, 1.0).ranked;
  ranked.resize(std::min(ranked.size(), kMostShown));
  return ranked;
}

}  // namespace flexarm::diagnose
