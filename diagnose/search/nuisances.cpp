#include "diagnose/search/nuisances.hpp"

#include "diagnose/search/channel_independence.hpp"
#include "diagnose/search/dependence.hpp"
#include "diagnose/search/explanation.hpp"
#include "diagnose/search/residual_test.hpp"

#include <utility>

namespace flexarm::diagnose {

std::optional<TimedProblem> with_timing(const Problem& problem, const Candidate& set,
                                        const SelectionOptions& options) {
  if (!problem.is_driven_by_torque()) return std::nullopt;
  const Explanation recorded = explain(problem, evaluated(problem, set));
  const bool is_small = recorded.estimation.unexplained_error() <= options.largest_timing_error;
  if (recorded.leaves_noise() || !is_small) return std::nullopt;
  const auto timing_of = [&set](const Problem& with_torques) {
    return torque_timing(with_torques, fit(with_torques, set, {.most_steps = 0}));
  };
  TorqueTiming timing = timing_of(problem);
  if (timing.share < options.least_timing_share) return std::nullopt;
  TimedProblem timed{problem, std::move(timing)};
  timed.problem.replace_torques(retimed(problem.experiment(), timed.timing));
  // The timing is linearised about the torques, so that these are corrected twice.
  timed.problem.replace_torques(retimed(timed.problem.experiment(), timing_of(timed.problem)));
  return timed;
}

std::optional<Problem> with_noise_colour(const Problem& problem, const Candidate& set, double level,
                                         ReportedWork& work) {
  if (problem.predictor().noise() || problem.has_coloured_noise()) return std::nullopt;
  const auto leaves_noise_in = [&set](const Problem& noise) {
    return explain(noise, evaluated(noise, set)).leaves_noise();
  };
  if (leaves_noise_in(problem)) return std::nullopt;
  auto coloured = problem.with_coloured_noise(set);
  if (!coloured || exceeds_noise_of_one_sensor(*coloured, problem)) return std::nullopt;
  if (!leaves_noise_in(*coloured)) return std::nullopt;
  if (dependence_p_value(*coloured, set, work, level) < level) return std::nullopt;
  return coloured;
}

}  // namespace flexarm::diagnose
