#include "diagnose/search/coarse_problems.hpp"

#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
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

/// A filter follows whole runs.
bool is_of_whole_runs(const Problem& problem) {
  const auto& noise = problem.predictor().noise();
  return noise && !noise->is_torque_noise();
}

Problem coarse_problem(const Problem& problem, std::size_t samples,
                       const SelectionOptions& options) {
  const Experiment& experiment = problem.experiment();
  return {std::make_shared<const Experiment>(is_of_whole_runs(problem)
                                                 ? coarse_whole(experiment, samples)
                                                 : coarse(experiment, samples)),
          coarse_options(problem, options)};
}

/// Mean square of residuals less that of noise, of the first `samples` of the `time` runs for
/// estimation.
double mean_excess(const Problem& problem, const Eigen::VectorXd& residuals, std::size_t samples) {
  double squares = 0.0;
  double count = 0.0;
  for (const ObservedChannel& channel : problem.observations().channels) {
    const auto& run = problem.experiment().runs[channel.run].run;
    if (!problem.estimation_runs()[channel.run] || run.kind != measured::RunKind::time) continue;
    const auto n = std::min<Eigen::Index>(channel.count, static_cast<Eigen::Index>(samples));
    squares += residuals.segment(channel.first, n).squaredNorm();
    count += static_cast<double>(n);
  }
  return count > 0.0 ? squares / count - 1.0 : 0.0;
}

std::size_t coarse_samples(const Problem& problem, const SelectionOptions& options) {
  return has_controllers(problem.experiment()) ? options.coarse_loop_samples
                                               : options.coarse_samples;
}

}  // namespace

CoarseProblems::CoarseProblems(const Problem& problem, const SelectionOptions& options)
    : options_(options),
      coarse_samples_(coarse_samples(problem, options)),
      early_samples_(options.short_samples),
      coarse_(coarse_problem(problem, coarse_samples_, options)),
      early_(coarse_problem(problem, early_samples_, options)) {}

bool CoarseProblems::lengthen(const Problem& problem, const Eigen::VectorXd& residuals) {
  constexpr double kShown = 0.1;
  constexpr double kShownSurely = 1.0;
  if (is_of_whole_runs(problem)) return false;
  const std::size_t most = options_.most_coarse_samples;
  const double whole = mean_excess(problem, residuals, most);
  if (!(whole > 0.0)) return false;
  const double least = std::min(kShown * whole, kShownSurely);
  const auto longer = [&](std::size_t samples) {
    while (2 * samples <= most && mean_excess(problem, residuals, samples) < least) samples *= 2;
    return samples;
  };
  const std::size_t early = longer(early_samples_);
  const std::size_t coarse = std::max(early, longer(coarse_samples_));
  if (early == early_samples_ && coarse == coarse_samples_) return false;
  if (early > early_samples_) early_ = coarse_problem(problem, early, options_);
  if (coarse > coarse_samples_) coarse_ = coarse_problem(problem, coarse, options_);
  early_samples_ = early;
  coarse_samples_ = coarse;
  return true;
}

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
