#include "diagnose/search/predicted_selection.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "arm/uncertainties.hpp"
#include "diagnose/motion_drive.hpp"
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/predictors/response_runs.hpp"
#include "diagnose/search/coarse.hpp"
#include "diagnose/search/torque_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Flexible modes of a Kalman filter that estimates a disturbance <= this. What leaves no noise by
/// output error is wrong by more than the modes beyond.
constexpr int kMostFilteredModes = 6;

bool shows_hub(const measured::TimeRecord& record) {
  return std::ranges::any_of(
      record.channels, [](const auto& channel) { return arm::is_collocated(channel.sensor); });
}

/// What a hub sensor shows is the motion that the torque is balanced for, so that the balance does
/// not judge that sensor.
bool is_on_hub_sensor(const Hypothesis& hypothesis) {
  return !hypothesis.sensor.empty() && arm::is_collocated(arm::parse_sensor(hypothesis.sensor));
}

/// Of the predictors with a noise model: torque balance where each `time` run shows the hub.
PredictorKind filtering_predictor(const Experiment& experiment, const SelectionOptions& options) {
  if (options.predictor) return *options.predictor;
  const bool is_seen = std::ranges::all_of(experiment.runs, [](const auto& run) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    return record == nullptr || shows_hub(*record);
  });
  return is_seen ? PredictorKind::torque_balance : PredictorKind::grey_box;
}

/// What a filter is given: the recorded torque, and whole runs decimated to what is enough for a
/// torque on the hub.
Problem filtered_problem(const Experiment& experiment, int flexible_modes,
                         const SelectionOptions& options) {
  const auto decimated = std::make_shared<const Experiment>(
      decimated_whole(without_controllers(experiment), options.filtered_samples));
  return {decimated, {.flexible_modes = flexible_modes, .deadline = options.deadline}};
}

/// With the readings of hub sensors alone.
Experiment seen_at_hub(Experiment experiment) {
  for (auto& run : experiment.runs) {
    auto* record = std::get_if<measured::TimeRecord>(&run.data);
    if (record == nullptr) continue;
    std::erase_if(record->channels,
                  [](const auto& channel) { return !arm::is_collocated(channel.sensor); });
  }
  return experiment;
}

/// What acts on the hub or its torque, and is not in the arm.
std::vector<Hypothesis> of_hub_alone(std::vector<Hypothesis> hypotheses, const arm::Arm& arm) {
  std::erase_if(hypotheses, [&](const Hypothesis& one) {
    return acts_beside_motion(one) || arm.effects.contains(one.effect);
  });
  return hypotheses;
}

/// Linear, and without loss at the hub: the error of the reaction of a beam that is wrong is, too.
bool acts_like_reaction(const Hypothesis& one, const arm::Arm& arm) {
  const auto friction_N_m_s_per_rad = [](const arm::Arm& of) {
    return arm::linear_arm(of).hub_viscous_friction_N_m_s_per_rad;
  };
  return one.shows_in(measured::RunKind::frf) &&
         friction_N_m_s_per_rad(extended(arm, one, one.middle())) == friction_N_m_s_per_rad(arm);
}

/// By motion in half of the time; empty where that is not the input of every run.
std::optional<Selection> of_the_rest(const SelectionTask& task, const Experiment& experiment,
                                     const DiagnosisProgress& progress) {
  SelectionOptions options = task.options;
  options.deadline = halfway(options.deadline);
  try {
    return select_by_motion({task.hypotheses, options}, experiment, progress).selection;
  } catch (const arm::InputError&) {
    return std::nullopt;  // a run without a hub sensor, or without another one
  }
}

}  // namespace

Candidate PredictedSelection::whole(Candidate candidate) const {
  if (!by_motion) return candidate;
  Candidate made = by_motion->chosen.fit.candidate;
  std::ranges::move(candidate.effects, std::back_inserter(made.effects));
  std::ranges::move(candidate.values, std::back_inserter(made.values));
  // Both deviate from the number of the file by their sum: its logarithm is what is normal.
  for (std::size_t i = 0; i < made.nuisances.size(); ++i) {
    made.nuisances[i] += candidate.nuisances[i];
  }
  return made;
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
      {.deadline = task.options.deadline});
  return select_by_simulation({searched, task.options}, driven, progress);
}

std::optional<PredictedSelection> select_by_filter(const SelectionTask& task,
                                                   const PredictedSelection& by_simulation,
                                                   const DiagnosisProgress& progress) {
  const auto& [hypotheses, options] = task;
  ReportedWork work(progress, options.deadline);
  work.tell(kNoiseStage, 0.0);
  Experiment experiment = by_simulation.simulated.experiment();
  const int modes =
      std::min(kMostFilteredModes, by_simulation.simulated.predictor().flexible_modes());
  const auto estimator_of = [&work](const Problem& problem) {
    return NoiseEstimator(problem.experiment(), problem.observations(), problem.predictor(),
                          [&work] { work.go_on(); });
  };
  std::optional<NoiseEstimate> left;  // by what simulation named
  const arm::Arm extended = by_simulation.selection.chosen.fit.candidate.extend(experiment.arm);
  if (!task.is_asked()) {
    const Problem unfiltered = filtered_problem(experiment, modes, options);
    const NoiseEstimator estimator = estimator_of(unfiltered);
    left = estimator.model(extended, unfiltered.estimation_runs());
    const double least_N_m = options.least_disturbance * estimator.torque_rms_N_m();
    if (left->model.disturbance_N_m <= least_N_m) return std::nullopt;
  }
  const PredictorKind kind = filtering_predictor(experiment, options);
  std::vector<Hypothesis> searched = hypotheses;
  std::optional<Selection> by_motion;
  if (kind == PredictorKind::torque_balance) std::erase_if(searched, is_on_hub_sensor);
  if (kind == PredictorKind::torque_balance && !task.is_asked()) {
    by_motion = of_the_rest(task, experiment, part_of(progress, 0.0, 0.5));
  }
  if (by_motion) {
    if (by_motion->cancelled) throw Cancelled();
    experiment = seen_at_hub(std::move(experiment));
    experiment.arm = by_motion->chosen.fit.candidate.extend(experiment.arm);
    searched = of_hub_alone(std::move(searched), experiment.arm);
    if (!by_motion->chosen.leaves_noise()) {
      std::erase_if(searched,
                    [&](const Hypothesis& one) { return acts_like_reaction(one, experiment.arm); });
    }
  }
  // The search begins with the arm as filed: what simulation named may be wrong.
  const Problem unfiltered = filtered_problem(experiment, modes, options);
  const bool is_known = left && !by_motion && extended == experiment.arm;
  const NoiseEstimator estimator = estimator_of(unfiltered);
  NoiseEstimate found =
      is_known ? *left : estimator.model(experiment.arm, unfiltered.estimation_runs());
  if (kind == PredictorKind::grey_box) {
    found = estimator.with_modal_force(experiment.arm, unfiltered.estimation_runs(), found);
  }
  NoiseModel& noise = found.model;
  if (kind == PredictorKind::torque_balance) {
    noise.balance_unit_N_m = estimated_disturbance_N_m(unfiltered.predictor(), experiment.arm,
                                                       unfiltered.estimation_runs(), noise);
  }
  PredictedSelection made{.selection = select(unfiltered.with_noise(noise), searched, options,
                                              by_motion ? part_of(progress, 0.5, 1.0) : progress),
                          .predictor = kind,
                          .reason = "as asked for",
                          .by_motion = std::move(by_motion),
                          .simulated = by_simulation.simulated};
  if (kind == PredictorKind::torque_balance) made.balance = made.selection.problem;
  if (made.by_motion && !made.selection.end) made.selection.end = made.by_motion->end;
  if (!task.is_asked()) {
    made.reason = fmt::format(
        "by simulation the residuals are not noise; an unrecorded hub torque of {:.3g} N m makes "
        "them more likely{}",
        noise.disturbance_N_m,
        made.by_motion ? "; effects on beam, payload and sensors are those that the measured "
                         "motion of the hub shows (driven_by_motion)"
                       : "");
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
  const Problem problem(std::make_shared<const Experiment>(*std::move(responses)), {});
  return PredictedSelection{.selection = select(problem, searched, options, progress),
                            .predictor = PredictorKind::frequency_response,
                            .reason = "as asked for",
                            .simulated = by_simulation.simulated};
}

}  // namespace flexarm::diagnose
