#include "diagnose/search/predictor_choice.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "arm/sensor.hpp"
#include "diagnose/predictors/response_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// A simulation that errs less than this more than another is about as good.
constexpr double kAbout = 1.05;

/// NRMSE of a simulation that says less of the data than their means do.
constexpr double kRanAway = 1.0;

/// NRMSE of a loop that is not that of the data.
constexpr double kDiverged = 10.0;

/// Of one whose controllers are stated, with the loop if it can be simulated with the arm file.
/// Else, and by output error where that is asked for, from the recorded torque; `note` says why.
Problem simulated_problem(const Experiment& experiment, const SelectionOptions& options,
                          std::string& note) {
  const ProblemOptions until_then{.policy = options.policy, .deadline = options.deadline};
  if (!has_controllers(experiment)) return Problem(experiment, until_then).until({});
  if (options.predictor != PredictorKind::output_error) {
    try {
      const Problem loop = Problem(experiment, until_then).until({});
      const auto left = loop.until(options.last).residuals(loop.as_filed(), loop.estimation_runs());
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
  return Problem(std::make_shared<const Experiment>(without_controllers(experiment)), until_then)
      .until({});
}

/// Root mean square of what the chosen effects leave, over that of the noise.
double over_noise(const Selection& selection) {
  const Explanation& chosen = selection.chosen;
  const Misfit& judged = chosen.validation.count > 0.0 ? chosen.validation : chosen.estimation;
  return std::sqrt(judged.sum_of_squares / judged.count);
}

/// Whether responses are nearer to their noise with what they identify than simulations are with
/// what these do. With the effects of the former a simulation may err no more than the baseline,
/// and, refitted, no more than with those of the latter: what shows in time alone, as dry friction
/// does, is noise of a response. Throws Cancelled after the deadline.
bool responses_are_better(const PredictedSelection& by_responses, const PredictedSelection& made,
                          const Deadline& deadline) {
  const Candidate& named = by_responses.selection.chosen.fit.candidate;
  if (named.effects.empty()) return false;
  if (!(over_noise(by_responses.selection) < over_noise(made.selection))) return false;
  const Problem simulated = made.simulated.until(deadline);
  const auto& arm = simulated.experiment().arm;
  const double baseline_error = simulated.judged_error(simulated.as_filed().extend(arm));
  if (simulated.judged_error(named.extend(arm)) > kAbout * baseline_error) return false;
  const Candidate refitted = fit(simulated, named).candidate;
  const double error = simulated.judged_error(made.selection.chosen.fit.candidate.extend(arm));
  return simulated.judged_error(refitted.extend(arm)) <= kAbout * error;
}

/// Returns the error of the judged runs as the predictor has it: of a torque balance that of the
/// torque for the measured motion, of a filter the torque that is missing, both relative to the
/// torque. A simulation adds up what is missing, and may run away.
double own_error(const PredictedSelection& made) {
  const Explanation& chosen = made.selection.chosen;
  const Misfit& judged = chosen.validation.count > 0.0 ? chosen.validation : chosen.estimation;
  if (made.law && made.law->found) return made.simulated_error();
  if (made.balance) return judged.relative_error;
  return judged.disturbance ? judged.disturbance->estimated_relative() : made.simulated_error();
}

/// Returns what a selection begins with that nothing was searched for before.
PredictedSelection unsearched(const Problem& problem) {
  return {.selection = Selection{problem}, .reason = "", .simulated = problem};
}

/// Returns whether every run shows the motion of the hub.
bool shows_hub(const Experiment& experiment) {
  return std::ranges::all_of(experiment.runs, [](const auto& run) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    return record != nullptr && std::ranges::any_of(record->channels, [](const auto& channel) {
             return arm::is_collocated(channel.sensor);
           });
  });
}

/// Returns the selection by the torque balance with part of the time; empty where not every run
/// shows the hub, or the time is over.
std::optional<PredictedSelection> balance_before_simulation(const SelectionTask& task,
                                                            const Problem& problem,
                                                            const DiagnosisProgress& progress) {
  if (!shows_hub(problem.experiment())) return std::nullopt;
  SelectionOptions options = task.options;
  options.deadline = halfway(options.deadline);
  try {
    return select_by_balance({task.hypotheses, options}, problem, progress);
  } catch (const arm::InputError&) {
    return std::nullopt;  // a hub sensor that is late by the arm file
  } catch (const Cancelled&) {
    require_time(task.options.deadline);
    return std::nullopt;
  }
}

/// Selects by a filter, or by the torque balance where every run shows the hub. Empty where that
/// has no use (select_by_filter). Throws InputError where neither can be formed.
std::optional<PredictedSelection> select_at_hub(const SelectionTask& task,
                                                const PredictedSelection& made,
                                                const DiagnosisProgress& progress) {
  if (!shows_hub(made.simulated.experiment())) return select_by_filter(task, made, progress);
  return select_by_balance(task, made.simulated, progress);
}

/// Selects by responses or at the hub (`balanced`, where that was done) where `made` by simulation
/// does not leave noise. Throws Cancelled after the deadline, with `made` as it was.
PredictedSelection select_beyond_simulation(PredictedSelection& made,
                                            std::optional<PredictedSelection> balanced,
                                            const SelectionTask& task,
                                            const DiagnosisProgress& progress) {
  made.reason = "an unrecorded torque on the hub explains little of what it leaves";
  if (auto responses = select_by_responses(task, made, part_of(progress, 0.6, 0.7))) {
    if (responses->selection.cancelled) return *std::move(responses);
    if (responses_are_better(*responses, made, task.options.deadline)) {
      responses->reason = fmt::format(
          "their residuals have {:.3g} times the standard deviation of their noise; those of a "
          "simulation have {:.3g} times that of theirs",
          over_noise(responses->selection), over_noise(made.selection));
      return *std::move(responses);
    }
  }
  try {
    auto at_hub =
        balanced ? std::move(balanced) : select_at_hub(task, made, part_of(progress, 0.7, 1.0));
    if (!at_hub) return std::move(made);
    Selection& other = at_hub->selection;
    if (other.end && at_hub->names_nothing()) {
      made.reason = kNoTime;
      if (!made.selection.end) made.selection.end = other.end;
      return std::move(made);
    }
    // Only without causes: a cause that is named where such a law acts explains a part of it.
    if (at_hub->names_nothing() && at_hub->balance) {
      at_hub->law = SoughtLaw{at_hub->law_beside_causes(task.options.deadline)};
    }
    const double error_at_hub = own_error(*at_hub);
    const double error_of_simulation = own_error(made);
    const double simulated_error = at_hub->simulated_error();
    const Problem& simulated = made.simulated;
    const bool is_worse =
        simulated_error > kAbout * simulated.judged_error(simulated.experiment().arm);
    const std::string errors =
        fmt::format("it leaves {:.3g} % of the torque, a simulation {:.3g} % of the signals",
                    100.0 * error_at_hub, 100.0 * error_of_simulation);
    if (other.cancelled || simulated_error < error_of_simulation ||
        (error_at_hub <= error_of_simulation && !is_worse)) {
      if (!other.end) other.end = made.selection.end;
      if (at_hub->balance) at_hub->reason = errors;
      return *std::move(at_hub);
    }
    if (at_hub->names_nothing()) made.balance = at_hub->balance;
    made.reason = fmt::format("its residuals are not noise; a {} is not reported: {}",
                              at_hub->balance ? "torque balance" : "stochastic grey box", errors);
  } catch (const arm::InputError& error) {
    made.reason = fmt::format("no other can be formed ({})", error.what());
  }
  return std::move(made);
}

/// Whether the residuals of the arm as filed are noise; false after the deadline. The search that
/// follows begins with what the predictor then keeps.
bool is_adequate(const Problem& problem, const arm::Deadline& deadline) {
  try {
    const Problem in_time = problem.until(deadline);
    return explain(in_time, evaluated(in_time, in_time.as_filed())).leaves_noise();
  } catch (const Cancelled&) {
    return false;
  }
}

/// Returns whether no effect of a selection is supported by the validation runs (grade_of).
bool is_doubtful(const Selection& selection) {
  if (selection.chosen.fit.candidate.effects.empty()) return true;
  return selection.problem.has_validation_runs() &&
         std::ranges::all_of(selection.evidence, [](const EffectEvidence& one) {
           return grade_of(one, false, false) == Grade::candidate;
         });
}

/// Selects with noise of the recorded torque where that leaves noise beside no effect, else by
/// simulation. Where that does not leave noise, noise of the torque is tried beside the effects
/// that it names. The other predictors are tried where it supports none, or errs by more than
/// kUseless. Where a simulation of the arm as filed runs away, the effects that the torque balance
/// shows are what the search begins with; of an arm without a beam they are the result, if the
/// validation runs support one and the balance leaves less than the torque itself.
PredictedSelection select_unasked(const SelectionTask& task, const Problem& problem,
                                  const DiagnosisProgress& progress) {
  const auto beside = [&](const std::vector<Hypothesis>& effects, double from, double to) {
    return select_with_torque_noise({effects, task.options}, problem, part_of(progress, from, to));
  };
  if (!is_adequate(problem, task.options.deadline)) {
    if (auto noisy = beside({}, 0.0, 0.1)) return *std::move(noisy);
  }
  std::optional<PredictedSelection> balanced;
  SelectionOptions options = task.options;
  const arm::Arm& arm = problem.experiment().arm;
  try {
    const double error = problem.until(options.deadline).judged_error(arm);
    if (error > kRanAway) {
      balanced = balance_before_simulation(task, problem, part_of(progress, 0.1, 0.3));
    }
    if (balanced && balanced->selection.cancelled) return *std::move(balanced);
    if (balanced && !arm::has_beam(arm) && !balanced->selection.end &&
        !is_doubtful(balanced->selection) && own_error(*balanced) < kRanAway) {
      balanced->reason = fmt::format(
          "a simulation of the arm file leaves {:.3g} % of the signals, and the torque that a "
          "motion takes shows all of an arm without a beam",
          100.0 * error);
      return *std::move(balanced);
    }
    if (balanced) options.starts.push_back(balanced->selection.chosen.fit.candidate);
  } catch (const Cancelled&) {
    // The simulation says that no time is left.
  }
  PredictedSelection made =
      select_by_simulation({task.hypotheses, options}, problem, part_of(progress, 0.3, 0.7));
  if (made.selection.cancelled) return made;
  if (made.selection.chosen.leaves_noise()) {
    made.reason = "its residuals are noise";
    return made;
  }
  const std::vector<Hypothesis> named = made.selection.chosen.fit.candidate.effects;
  try {
    if (!balanced) require_time(task.options.deadline);
    if (!named.empty() && !is_over(task.options.deadline)) {
      if (auto noisy = beside(named, 0.7, 0.8)) return *std::move(noisy);
    }
    if (balanced || is_doubtful(made.selection) ||
        made.simulated_error() > options.policy.useless) {
      return select_beyond_simulation(made, std::move(balanced), task, progress);
    }
    made.reason =
        "others are tried where a simulation supports no effect, or leaves half of the signal";
  } catch (const Cancelled&) {
    made.selection.cancelled = !is_over(task.options.deadline);
    made.reason = kNoTime;
  }
  return made;
}

/// By the filter of options.predictor.
PredictedSelection select_by_asked_filter(const SelectionTask& task, const Problem& problem,
                                          const DiagnosisProgress& progress) {
  try {
    return task.options.predictor == PredictorKind::torque_balance
               ? select_by_balance(task, problem, progress)
               : *select_by_filter(task, unsearched(problem), progress);
  } catch (const Cancelled&) {
    if (is_over(task.options.deadline)) {
      PredictedSelection made = select_by_simulation(task, problem, progress);
      made.reason = kNoTime;
      made.selection.end = SearchEnd{kNoiseStage, {}};
      return made;
    }
    PredictedSelection made = unsearched(problem);
    made.selection.cancelled = true;
    return made;
  }
}

/// By responses. Throws InputError where no torque is rich enough.
PredictedSelection select_by_asked_responses(const SelectionTask& task, const Problem& problem,
                                             const DiagnosisProgress& progress) {
  auto made = select_by_responses(task, unsearched(problem), progress);
  if (!made) {
    throw arm::InputError(fmt::format(
        "predictor frequency_response: no torque is rich enough; a run needs {} lines of a "
        "response with a standard deviation of {:g} % or less, over a factor of {:g} in frequency",
        kLeastLines, 100.0 * kLargestLineError, kLeastSpan));
  }
  return *std::move(made);
}

}  // namespace

PredictedSelection select_by_evidence(const Experiment& experiment,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const SelectionOptions& options,
                                      const DiagnosisProgress& progress) {
  const SelectionTask task{hypotheses, options};
  const auto asked = options.predictor;
  if (asked == PredictorKind::closed_loop && !has_controllers(experiment)) {
    throw arm::InputError("predictor closed_loop: no run states its controller");
  }
  if (asked == PredictorKind::driven_by_motion) {
    return select_by_motion(task, experiment, progress);
  }
  std::string note;
  const Problem problem = simulated_problem(experiment, options, note);
  if (!has_runs(experiment, measured::Purpose::estimation, measured::RunKind::time)) {
    PredictedSelection made = select_by_simulation(task, problem, progress);
    made.reason = "";
    return made;
  }
  const auto selected = !asked                                        ? select_unasked
                        : is_simulation(*asked)                       ? select_by_simulation
                        : *asked == PredictorKind::frequency_response ? select_by_asked_responses
                                                                      : select_by_asked_filter;
  PredictedSelection made = selected(task, problem, progress);
  made.reason = note + made.reason;
  return made;
}

}  // namespace flexarm::diagnose
