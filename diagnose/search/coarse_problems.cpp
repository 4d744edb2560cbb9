#include "diagnose/search/coarse_problems.hpp"

#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// The noise model for an experiment with the estimation runs alone.
std::optional<NoiseModel> noise_of_estimation(const Problem& problem) {
  std::optional<NoiseModel> noise = problem.predictor().noise();
  if (!noise || !noise->is_torque_noise()) return noise;
  std::vector<double> of_estimation_N_m;
  for (std::size_t r = 0; r < noise->torque_noise_N_m.size(); ++r) {
    if (problem.estimation_runs()[r]) of_estimation_N_m.push_back(noise->torque_noise_N_m[r]);
  }
  noise->torque_noise_N_m = std::move(of_estimation_N_m);
  return noise;
}

ProblemOptions coarse_options(const Problem& problem, const SelectionOptions& options) {
  return {.flexible_modes = std::min(options.coarse_modes, problem.predictor().flexible_modes()),
          .noise = noise_of_estimation(problem)};
}

Experiment coarse_experiment(const Problem& problem, std::size_t samples) {
  const auto& noise = problem.predictor().noise();
  return noise && !noise->is_torque_noise() ? coarse_whole(problem.experiment(), samples)
                                            : coarse(problem.experiment(), samples);
}

std::size_t coarse_samples(const Problem& problem, const SelectionOptions& options) {
  return has_controllers(problem.experiment()) ? options.coarse_loop_samples
                                               : options.coarse_samples;
}

}  // namespace

CoarseProblems::CoarseProblems(const Problem& problem, const SelectionOptions& options)
    : coarse_experiment_(coarse_experiment(problem, coarse_samples(problem, options))),
      early_experiment_(coarse_experiment(problem, options.short_samples)),
      coarse_(coarse_experiment_, coarse_options(problem, options)),
      early_(early_experiment_, coarse_options(problem, options)) {}

bool CoarseProblems::is_early_shorter() const {
  return early_.observations().values.size() < coarse_.observations().values.size();
}

Fit coarse_fit(const Problem& part, const Candidate& start, const ReportedWork& work) {
  constexpr int kSteps = 8;
  constexpr double kTolerance = 1e-4;
  return fit(part, start,
             {.most_steps = kSteps,
              .tolerance = kTolerance,
              .is_differenced_at_end = false,
              .work = &work});
}

}  // namespace flexarm::diagnose
