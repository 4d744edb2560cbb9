#include "diagnose/search/predicted_selection.hpp"

#include "arm/input_error.hpp"
#include "arm/sensor.hpp"
#include "diagnose/motion_drive.hpp"
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/predictors/response_runs.hpp"
#include "diagnose/search/coarse.hpp"
#include "diagnose/search/torque_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Flexible modes of a Kalman filter that estimates a disturbance <= this. What leaves no noise by
/// output error is wrong by more than the modes beyond.
constexpr int kMostFilteredModes = 6;

/// What a hub sensor shows is the motion that the torque is balanced for, so that the balance does
/// not judge that sensor.
bool is_on_hub_sensor(const Hypothesis& hypothesis) {
  return !hypothesis.sensor.empty() && arm::is_collocated(arm::parse_sensor(hypothesis.sensor));
}

/// Returns the runs with the recorded torque, whole and decimated to what is enough for a torque on
/// the hub.
Experiment decimated_runs(const Experiment& experiment, const SelectionOptions& options) {
  return decimated_whole(without_controllers(experiment), options.filtered_samples);
}

/// Returns the problem that a filter is given.
Problem filtered_problem(const Experiment& experiment, int flexible_modes,
                         const SelectionOptions& options) {
  return {
      std::make_shared<const Experiment>(decimated_runs(experiment, options)),
      {.flexible_modes = flexible_modes, .policy = options.policy, .deadline = options.deadline}};
}

}  // namespace

double PredictedSelection::simulated_error() const {
  if (law && law->found) return law->found->error_after;
  const Candidate& chosen = selection.chosen.fit.candidate;
  return simulated.judged_error(chosen.extend(simulated.experiment().arm));
}

std::optional<EmpiricalLaw> PredictedSelection::law_beside_causes(const Deadline& deadline) const {
  if (law) return law->found;
  return empirical_law(balance.value().until(deadline), simulated.until(deadline),
                       selection.chosen.fit.candidate);
}

DiagnosisProgress part_of(const DiagnosisProgress& progress, double from, double to) {
  return [&progress, from, to](std::string_view what, double done) {
    return !progress || progress(what, from + (to - from) * done);
  };
}

PredictedSelection select_by_simulation(const SelectionTask& task, const Problem& problem,
                                        const DiagnosisProgress& progress) {
  Selection selection = select(problem, task.hypotheses, task.options, progress);
  const Problem simulated = selection.problem;
  auto kind = PredictorKind::output_error;
  if (has_controllers(problem.experiment())) kind = PredictorKind::closed_loop;
  if (is_driven_by_motion(problem.experiment())) kind = PredictorKind::driven_by_motion;
  return {.selection = std::move(selection),
          .predictor = kind,
          .reason = "as asked for",
          .simulated = simulated};
}

PredictedSelection select_by_motion(const SelectionTask& task, const Experiment& experiment,
                                    const DiagnosisProgress& progress) {
  std::vector<Hypothesis> searched = task.hypotheses;
  std::erase_if(searched, [](const Hypothesis& one) { return !acts_beside_motion(one); });
  const Problem driven(
      std::make_shared<const Experiment>(driven_by_motion(without_controllers(experiment))),
      {.policy = task.options.policy, .deadline = task.options.deadline});
  return select_by_simulation({searched, task.options}, driven, progress);
}

PredictedSelection select_by_balance(const SelectionTask& task, const Problem& simulated,
                                     const DiagnosisProgress& progress) {
  const Problem balance(std::make_shared<const Experiment>(
                            balanced_at_hub(decimated_runs(simulated.experiment(), task.options))),
                        {.flexible_modes = simulated.predictor().flexible_modes(),
                         .policy = task.options.policy,
                         .deadline = task.options.deadline});
  std::vector<Hypothesis> searched = task.hypotheses;
  std::erase_if(searched, is_on_hub_sensor);
  Selection selection = select(balance, searched, task.options, progress);
  const Problem balanced = selection.problem;
  return {.selection = std::move(selection),
          .predictor = PredictorKind::torque_balance,
          .reason = "as asked for",
          .balance = balanced,
          .simulated = simulated};
}

std::optional<PredictedSelection> select_by_filter(const SelectionTask& task,
                                                   const PredictedSelection& by_simulation,
                                                   const DiagnosisProgress& progress) {
  const auto& [hypotheses, options] = task;
  ReportedWork work(progress, options.deadline);
  work.tell(kNoiseStage, 0.0);
  const Experiment& experiment = by_simulation.simulated.experiment();
  const Problem unfiltered = filtered_problem(
      experiment,
      std::min(kMostFilteredModes, by_simulation.simulated.predictor().flexible_modes()), options);
  const auto& runs = unfiltered.estimation_runs();
  const NoiseEstimator estimator(unfiltered.experiment(), unfiltered.observations(),
                                 unfiltered.predictor(), [&work] { work.go_on(); });
  // The search begins with the arm as filed: what simulation named may be wrong.
  NoiseEstimate found = estimator.model(experiment.arm, runs);
  if (!task.is_asked()) {
    const arm::Arm extended = by_simulation.selection.chosen.fit.candidate.extend(experiment.arm);
    const NoiseEstimate left = extended == experiment.arm ? found : estimator.model(extended, runs);
    const double least_N_m = options.least_disturbance * estimator.torque_rms_N_m();
    if (left.model.disturbance_N_m <= least_N_m) return std::nullopt;
  }
  found = estimator.with_modal_force(experiment.arm, runs, found);
  PredictedSelection made{
      .selection = select(unfiltered.with_noise(found.model), hypotheses, options, progress),
      .predictor = PredictorKind::grey_box,
      .reason = "as asked for",
      .simulated = by_simulation.simulated};
  if (!task.is_asked()) {
    made.reason = fmt::format(
        "by simulation the residuals are not noise; an unrecorded hub torque of {:.3g} N m makes "
        "them more likely",
        found.model.disturbance_N_m);
  }
  return made;
}

std::optional<PredictedSelection> select_with_torque_noise(const SelectionTask& task,
                                                           const Problem& problem,
                                                           const DiagnosisProgress& progress) {
  if (has_controllers(problem.experiment())) return std::nullopt;
  SelectionOptions options = task.options;
  options.deadline = halfway(options.deadline);
  try {
    const auto noisy = with_torque_noise(
        filtered_problem(problem.experiment(), problem.predictor().flexible_modes(), options));
    if (!noisy) return std::nullopt;
    Selection selection = select(*noisy, task.hypotheses, options, progress);
    const arm::Arm arm = selection.chosen.fit.candidate.extend(noisy->experiment().arm);
    const bool is_found =
        selection.chosen.leaves_noise() && torque_noise_is_likely(selection.problem, arm);
    if (!is_found && !selection.cancelled) return std::nullopt;
    return PredictedSelection{
        .selection = std::move(selection),
        .predictor = PredictorKind::grey_box,
        .reason =
            fmt::format("the recorded torque has white noise of {:.3g} N m rms, which makes the "
                        "residuals noise",
                        std::ranges::max(noisy->predictor().noise()->torque_noise_N_m)),
        .simulated = problem.with_more_noise(errors_of_torque(problem))};
  } catch (const arm::InputError&) {
    return std::nullopt;  // sensors that are too late for a Kalman filter
  } catch (const Cancelled&) {
    return std::nullopt;  // the deadline: `select` takes back what the user cancels
  }
}

std::optional<PredictedSelection> select_by_responses(const SelectionTask& task,
                                                      const PredictedSelection& by_simulation,
                                                      const DiagnosisProgress& progress) {
  if (is_over(task.options.deadline)) return std::nullopt;
  auto responses = as_responses(by_simulation.simulated.experiment());
  if (!responses) return std::nullopt;
  std::vector<Hypothesis> searched = task.hypotheses;
  std::erase_if(searched, [](const Hypothesis& hypothesis) {
    return !hypothesis.shows_in(measured::RunKind::frf);
  });
  SelectionOptions options = task.options;
  if (!task.is_asked()) options.deadline = halfway(options.deadline);
  const Problem problem(std::make_shared<const Experiment>(*std::move(responses)),
                        {.policy = options.policy});
  return PredictedSelection{.selection = select(problem, searched, options, progress),
                            .predictor = PredictorKind::frequency_response,
                            .reason = "as asked for",
                            .simulated = by_simulation.simulated};
}

}  // namespace flexarm::diagnose
