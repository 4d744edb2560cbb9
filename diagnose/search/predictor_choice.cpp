#include "diagnose/search/predictor_choice.hpp"

#include "arm/input_error.hpp"
#include "arm/sensor.hpp"
#include "arm/uncertainties.hpp"
#include "diagnose/motion_drive.hpp"
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/search/coarse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Flexible modes of a Kalman filter <= this. What leaves no noise by output error is wrong by more
/// than the modes beyond.
constexpr int kMostFilteredModes = 6;

/// A stage of the search that a time limit may end.
constexpr const char* kNoiseStage = "the noise of a Kalman filter";
constexpr const char* kNoTime = "the time limit left no time for another";

/// Relative standard deviation of a number that states none, where it is refitted: that of a
/// catalogue's density, or of an inertia from a drawing.
constexpr double kAssumedUncertainty = 0.1;

/// NRMSE of a loop that is not that of the data.
constexpr double kDiverged = 10.0;

bool fits_time_runs(const Experiment& experiment) {
  return std::ranges::any_of(experiment.runs, [](const auto& run) {
    return run.run.purpose == measured::Purpose::estimation &&
           run.run.kind == measured::RunKind::time;
  });
}

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

DiagnosisProgress part_of(const DiagnosisProgress& progress, double from, double to) {
  return [&progress, from, to](std::string_view what, double done) {
    return !progress || progress(what, from + (to - from) * done);
  };
}

/// What is done by whichever predictor.
struct Task {
  const std::vector<Hypothesis>& hypotheses;
  const SelectionOptions& options;

  bool is_asked() const { return options.predictor.has_value(); }
};

/// Of one whose controllers are stated, with the loop if it can be simulated with the arm file.
/// Else, and by output error where that is asked for, from the recorded torque; `note` says why.
Problem simulated_problem(const Experiment& experiment, const SelectionOptions& options,
                          std::string& note) {
  if (!has_controllers(experiment)) return Problem(experiment);
  if (options.predictor != PredictorKind::output_error) {
    try {
      Problem loop(experiment);
      const auto left = loop.residuals(loop.as_filed(), loop.estimation_runs());
      const auto& runs = loop.estimation_runs();
      if (left && misfit(loop.observations(), experiment, *left, runs).relative_error < kDiverged) {
        return loop;
      }
      note = "the loop diverges with the arm file; ";
    } catch (const arm::InputError& error) {
      note = fmt::format("the loop cannot be simulated with the arm file ({}); ", error.what());
    }
    if (options.predictor == PredictorKind::closed_loop) {
      throw arm::InputError(
          fmt::format("predictor closed_loop: {}", note.substr(0, note.rfind(';'))));
    }
  }
  return Problem(std::make_shared<const Experiment>(without_controllers(experiment)), {});
}

PredictedSelection select_by_simulation(const Task& task, const Problem& problem,
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

/// Where effects do not leave noise: what numbers of the arm file that state no uncertainty explain
/// if they are as uncertain as those of a data sheet, by themselves or beside one effect. Empty
/// where that does not leave noise either.
std::optional<PredictedSelection> select_with_assumed_numbers(const Task& task,
                                                              const Problem& problem,
                                                              const DiagnosisProgress& progress) {
  auto assumed = std::make_shared<Experiment>(problem.experiment());
  assumed->arm = arm::with_assumed_uncertainties(assumed->arm, kAssumedUncertainty);
  if (assumed->arm == problem.experiment().arm) return std::nullopt;
  SelectionOptions options = task.options;
  options.deadline = halfway(options.deadline);
  options.most_causes = 1;
  PredictedSelection made = select_by_simulation(
      {task.hypotheses, options},
      Problem(assumed, {.flexible_modes = problem.predictor().flexible_modes()}), progress);
  if (!made.selection.cancelled && !made.selection.chosen.leaves_noise()) return std::nullopt;
  made.reason = "its residuals are noise if numbers of the arm file are refitted";
  return made;
}

/// What a filter is given: the recorded torque, and whole runs decimated to what is enough for a
/// torque on the hub.
Problem filtered_problem(const Problem& simulated, const SelectionOptions& options) {
  const int modes = std::min(kMostFilteredModes, simulated.predictor().flexible_modes());
  const auto experiment = std::make_shared<const Experiment>(
      decimated_whole(without_controllers(simulated.experiment()), options.filtered_samples));
  return {experiment, {.flexible_modes = modes}};
}

/// The selection by a predictor with a noise model. Empty where that is not asked for and the
/// disturbance of the arm that simulation made is small. Throws Cancelled, and InputError where no
/// Kalman filter can be formed.
std::optional<PredictedSelection> select_by_filter(const Task& task,
                                                   const PredictedSelection& by_simulation,
                                                   const DiagnosisProgress& progress) {
  const auto& [hypotheses, options] = task;
  ReportedWork work(progress, options.deadline);
  work.tell(kNoiseStage, 0.0);
  const Problem unfiltered = filtered_problem(by_simulation.simulated, options);
  const Experiment& experiment = unfiltered.experiment();
  const NoiseEstimator estimator(experiment, unfiltered.observations(), unfiltered.predictor(),
                                 [&work] { work.go_on(); });
  const auto likely_noise = [&](const arm::Arm& arm) {
    return estimator.model(arm, unfiltered.estimation_runs()).model;
  };
  const arm::Arm extended = by_simulation.selection.chosen.fit.candidate.extend(experiment.arm);
  const double least_N_m = options.least_disturbance * estimator.torque_rms_N_m();
  NoiseModel noise = likely_noise(extended);
  if (!task.is_asked() && noise.disturbance_N_m <= least_N_m) return std::nullopt;
  // The search begins with the arm as filed: what simulation named may be wrong.
  if (extended != experiment.arm) noise = likely_noise(experiment.arm);
  const PredictorKind kind = filtering_predictor(experiment, options);
  std::vector<Hypothesis> searched = hypotheses;
  if (kind == PredictorKind::torque_balance) {
    noise.balance_unit_N_m = estimated_disturbance_N_m(unfiltered.predictor(), experiment.arm,
                                                       unfiltered.estimation_runs(), noise);
    std::erase_if(searched, is_on_hub_sensor);
  }
  PredictedSelection made{
      .selection = select(unfiltered.with_noise(noise), searched, options, progress),
      .predictor = kind,
      .reason = "as asked for",
      .simulated = by_simulation.simulated};
  if (kind == PredictorKind::torque_balance) made.balance = made.selection.problem;
  if (!task.is_asked()) {
    made.reason = fmt::format(
        "by simulation the residuals are not noise; an unrecorded hub torque of {:.3g} N m makes "
        "them more likely",
        noise.disturbance_N_m);
  }
  return made;
}

/// Of a simulation with the chosen effects.
double simulated_error(const PredictedSelection& made) {
  const Candidate& chosen = made.selection.chosen.fit.candidate;
  return made.simulated.judged_error(chosen.extend(made.simulated.experiment().arm));
}

/// By simulation, and where that does not leave noise by a filter; the first of them in half of the
/// time.
PredictedSelection select_by_both(const Task& task, const Problem& problem,
                                  const DiagnosisProgress& progress) {
  SelectionOptions first = task.options;
  first.deadline = halfway(task.options.deadline);
  PredictedSelection made =
      select_by_simulation({task.hypotheses, first}, problem, part_of(progress, 0.0, 0.5));
  if (made.selection.cancelled) return made;
  if (made.selection.chosen.leaves_noise()) {
    made.reason = "its residuals are noise";
    return made;
  }
  if (auto numbers = select_with_assumed_numbers(task, problem, part_of(progress, 0.5, 0.6))) {
    return *std::move(numbers);
  }
  made.reason = "an unrecorded torque on the hub explains little of what it leaves";
  try {
    auto filtered = select_by_filter(task, made, part_of(progress, 0.6, 1.0));
    if (!filtered) return made;
    Selection& other = filtered->selection;
    if (other.end && other.chosen.fit.candidate.effects.empty()) {
      made.reason = kNoTime;
      if (!made.selection.end) made.selection.end = other.end;
      return made;
    }
    const double by_filter = simulated_error(*filtered);
    const double by_simulation = simulated_error(made);
    if (other.cancelled || by_filter <= by_simulation) {
      if (!other.end) other.end = made.selection.end;
      return *std::move(filtered);
    }
    made.balance = filtered->balance;
    made.reason = fmt::format(
        "its residuals are not noise; with what a {} identifies NRMSE is {:.3g} %, "
        "with this {:.3g} %",
        filtered->predictor == PredictorKind::torque_balance ? "torque balance"
                                                             : "stochastic grey box",
        100.0 * by_filter, 100.0 * by_simulation);
  } catch (const Cancelled&) {
    made.selection.cancelled = !is_over(task.options.deadline);
    if (!made.selection.cancelled) {
      made.reason = kNoTime;
      if (!made.selection.end) made.selection.end = SearchEnd{kNoiseStage, {}};
    }
  } catch (const arm::InputError& error) {
    made.reason = fmt::format("no Kalman filter can be formed ({})", error.what());
  }
  return made;
}

/// By the filter of options.predictor.
PredictedSelection select_by_asked_filter(const Task& task, const Problem& problem,
                                          const DiagnosisProgress& progress) {
  PredictedSelection unsearched{
      .selection = Selection{problem}, .reason = "", .simulated = problem};
  try {
    return *select_by_filter(task, unsearched, progress);
  } catch (const Cancelled&) {
    if (is_over(task.options.deadline)) {
      PredictedSelection made = select_by_simulation(task, problem, progress);
      made.reason = kNoTime;
      made.selection.end = SearchEnd{kNoiseStage, {}};
      return made;
    }
    unsearched.selection.cancelled = true;
    return unsearched;
  }
}

/// With the hub's motion as the input.
PredictedSelection select_by_motion(const Task& task, const Experiment& experiment,
                                    const DiagnosisProgress& progress) {
  std::vector<Hypothesis> searched = task.hypotheses;
  std::erase_if(searched, [](const Hypothesis& one) { return !acts_beside_motion(one); });
  const Problem driven(std::make_shared<const Experiment>(driven_by_motion(experiment)), {});
  return select_by_simulation({searched, task.options}, driven, progress);
}

}  // namespace

PredictedSelection select_by_evidence(const Experiment& experiment,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const SelectionOptions& options,
                                      const DiagnosisProgress& progress) {
  const Task task{hypotheses, options};
  const auto asked = options.predictor;
  if (asked == PredictorKind::closed_loop && !has_controllers(experiment)) {
    throw arm::InputError("predictor closed_loop: no run states its controller");
  }
  if (asked == PredictorKind::driven_by_motion) {
    return select_by_motion(task, experiment, progress);
  }
  std::string note;
  const Problem problem = simulated_problem(experiment, options, note);
  if (!fits_time_runs(experiment)) {
    PredictedSelection made = select_by_simulation(task, problem, progress);
    made.reason.clear();
    return made;
  }
  const auto selected = !asked                  ? select_by_both
                        : is_simulation(*asked) ? select_by_simulation
                                                : select_by_asked_filter;
  PredictedSelection made = selected(task, problem, progress);
  made.reason = note + made.reason;
  return made;
}

}  // namespace flexarm::diagnose
