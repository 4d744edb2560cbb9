#include "diagnose/ranked/nuisances.hpp"

#include "diagnose/ranked/part_of_data.hpp"
#include "diagnose/search/channel_independence.hpp"
#include "diagnose/search/dependence_test.hpp"
#include "diagnose/search/explanation.hpp"
#include "diagnose/search/residual_test.hpp"

#include <utility>

namespace flexarm::diagnose {

namespace {

Explanation evaluated(const Problem& problem, const Candidate& set, bool has_derivatives) {
  return explain(problem,
                 fit(problem, set, {.most_steps = 0, .is_differenced_at_end = has_derivatives}));
}

}  // namespace

std::optional<TimedProblem> with_timing(const Problem& problem, const Candidate& set,
                                        const SelectionOptions& options) {
  if (!problem.is_driven_by_torque() || longest_run(problem.experiment()) == 0) {
    return std::nullopt;
  }
  const Explanation recorded = evaluated(problem, set, true);
  const bool is_small = recorded.estimation.unexplained_error() <= options.largest_timing_error;
  if (recorded.leaves_noise() || !is_small) return std::nullopt;
  TorqueTiming timing = torque_timing(problem, recorded.fit);
  if (timing.share < options.least_timing_share) return std::nullopt;
  TimedProblem timed{problem, std::move(timing)};
  timed.problem.replace_torques(retimed(problem.experiment(), timed.timing));
  // Once more from there: the timing is linearised about the torques.
  const Explanation again = evaluated(timed.problem, set, true);
  timed.problem.replace_torques(
      retimed(timed.problem.experiment(), torque_timing(timed.problem, again.fit)));
  return timed;
}

std::optional<Problem> with_noise_colour(const Problem& problem, const Candidate& set,
                                         ReportedWork& work) {
  if (problem.predictor().noise() || problem.has_coloured_noise()) return std::nullopt;
  if (evaluated(problem, set, false).leaves_noise()) return std::nullopt;
  auto coloured = problem.with_coloured_noise(set);
  if (!coloured || exceeds_noise_of_one_sensor(*coloured, problem)) return std::nullopt;
  if (!evaluated(*coloured, set, false).leaves_noise()) return std::nullopt;
  const DependenceTest dependence = test_dependence(*coloured, problem, set, work, kResidualLevel);
  if (dependence.p_value < kResidualLevel) return std::nullopt;
  return coloured;
}

}  // namespace flexarm::diagnose
