#include "diagnose/search/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// With what a stochastic grey-box model leaves to the disturbance, if the problem has one. What
/// is left is then noise where the innovations are white and the disturbance is negligible.
void weigh_disturbance(const Problem& problem, const Candidate& candidate,
                       const Eigen::VectorXd& residuals, const std::vector<bool>& runs,
                       Misfit& misfit, ResidualTest& test) {
  const auto& noise = problem.predictor().noise();
  if (!noise || noise->is_torque_noise() || misfit.count == 0.0) return;
  misfit.disturbance = problem.disturbance_left(candidate, runs);
  double& likelihood = misfit.disturbance->minus_two_log_likelihood;
  for (const ObservedChannel& channel : problem.observations().channels) {
    if (!runs[channel.run]) continue;
    if (problem.experiment().runs[channel.run].run.kind == measured::RunKind::time) continue;
    likelihood += residuals.segment(channel.first, channel.count).squaredNorm();
  }
  test.level_p_value = misfit.disturbance->relative() <= kNegligibleDisturbance ? 1.0 : 0.0;
}

/// With what a simulation errs by beyond what noise of the recorded torques adds to it, where that
/// noise is the disturbance.
void weigh_simulation(const Problem& problem, const Candidate& candidate,
                      const std::vector<bool>& runs, Misfit& misfit, ResidualTest& test) {
  const auto& noise = problem.predictor().noise();
  if (!noise || !noise->is_torque_noise()) return;
  const Observations& observations = problem.observations();
  Eigen::VectorXd errors = observations.values;
  try {
    errors -= problem.predictor()(candidate.extend(problem.experiment().arm), runs);
  } catch (const std::runtime_error&) {
    // An arm that is none, or a simulation that overflows.
    misfit.simulation_excess = std::numeric_limits<double>::infinity();
  }
  for (const ObservedChannel& channel : observations.channels) {
    if (!runs[channel.run] || channel.torque_error == 0.0) continue;
    for (const std::size_t k : channel.left_out) {
      errors(channel.first + static_cast<Eigen::Index>(k)) = 0.0;
    }
    const double expected = observations.deviations(channel.first) *
                            std::hypot(channel.floor(), channel.torque_error) / channel.floor();
    const double squares = (errors.segment(channel.first, channel.count) / expected).squaredNorm();
    const double most = kMostExpected * static_cast<double>(channel.used());
    misfit.simulation_excess += std::max(0.0, squares - most);
  }
  if (misfit.simulation_excess > 0.0) test.level_p_value = 0.0;
}

}  // namespace

Explanation explain(const Problem& problem, Fit fit) {
  Explanation made;
  const Observations& observations = problem.observations();
  made.held_out = Eigen::VectorXd::Zero(problem.residual_count());
  made.estimation =
      misfit(observations, problem.experiment(), fit.residuals, problem.estimation_runs());
  const Eigen::Index nuisances = problem.residual_count() - observations.values.size();
  made.estimation.nuisances = static_cast<double>(nuisances);
  made.estimation.nuisance_squares = fit.residuals.tail(nuisances).squaredNorm();
  made.estimation_test =
      test_residuals(observations, problem.experiment(), fit.residuals, problem.estimation_runs());
  weigh_disturbance(problem, fit.candidate, fit.residuals, problem.estimation_runs(),
                    made.estimation, made.estimation_test);
  weigh_simulation(problem, fit.candidate, problem.estimation_runs(), made.estimation,
                   made.estimation_test);
  if (const auto held_out = problem.residuals(fit.candidate, problem.validation_runs())) {
    made.held_out = *held_out;
    made.validation =
        misfit(observations, problem.experiment(), *held_out, problem.validation_runs());
    made.validation_test =
        test_residuals(observations, problem.experiment(), *held_out, problem.validation_runs());
    weigh_disturbance(problem, fit.candidate, *held_out, problem.validation_runs(), made.validation,
                      made.validation_test);
    weigh_simulation(problem, fit.candidate, problem.validation_runs(), made.validation,
                     made.validation_test);
  }
  made.fit = std::move(fit);
  return made;
}

std::vector<Explanation>::iterator find_set(std::vector<Explanation>& among,
                                            const Candidate& effects) {
  const auto labels = effects.labels();
  return std::ranges::find_if(
      among, [&](const Explanation& one) { return one.fit.candidate.labels() == labels; });
}

void sort_by_fit(std::vector<Explanation>& explanations) {
  std::ranges::stable_sort(explanations, {},
                           [](const Explanation& one) { return one.fit.sum_of_squares; });
}

double lead(const Explanation& fuller, const Explanation& simpler) {
  const auto more = static_cast<int>(fuller.fit.candidate.values.size()) -
                    static_cast<int>(simpler.fit.candidate.values.size());
  return information_gain(simpler.estimation, fuller.estimation, more);
}

}  // namespace flexarm::diagnose
