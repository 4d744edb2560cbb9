#include "diagnose/diagnosis.hpp"

#include "diagnose/motion_drive.hpp"
#include "diagnose/search/parameter_errors.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/rivals.hpp"
#include "diagnose/unknown/balanced_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Of those that were not named, as many are told.
constexpr std::size_t kNearMisses = 5;

std::vector<ChannelGain> channel_gains(const Problem& problem, const Eigen::VectorXd& before,
                                       const Eigen::VectorXd& after) {
  std::vector<ChannelGain> gains;
  const Observations& observations = problem.observations();
  const Experiment& experiment = problem.experiment();
  for (const ObservedChannel& channel : observations.channels) {
    gains.push_back({experiment.runs[channel.run].run.id,
                     channel.sensor,
                     {relative_error(observations, experiment, channel, before),
                      relative_error(observations, experiment, channel, after), channel.noise,
                      channel.numerical_error}});
  }
  return gains;
}

std::vector<Overlay> overlays(const Observations& observations, const Eigen::VectorXd& before,
                              const Eigen::VectorXd& after) {
  std::vector<Overlay> made;
  for (const ObservedChannel& channel : observations.channels) {
    const auto own = [&channel](const Eigen::VectorXd& all) {
      return all.segment(channel.first, channel.count);
    };
    const auto values = own(observations.values);
    const auto read = [](const Eigen::VectorXd& readings) {
      return std::vector<double>(readings.begin(), readings.end());
    };
    const auto simulated = [&](const Eigen::VectorXd& residuals) {
      return read(values - own(residuals).cwiseProduct(own(observations.deviations)));
    };
    made.push_back(
        {channel.run, channel.sensor, read(values), simulated(before), simulated(after)});
  }
  return made;
}

/// Refitted run by run: of the causes the leading one, else the best effect by itself where
/// something is wrong. Throws Cancelled after the deadline.
std::optional<RunDrift> drift_of(const Selection& selection, Verdict verdict,
                                 const std::vector<Cause>& causes, const Deadline& deadline) {
  const bool is_wrong = verdict == Verdict::unexplained && !selection.singles.empty();
  if (causes.empty() && !is_wrong) return std::nullopt;
  const Candidate& candidate =
      causes.empty() ? selection.singles.front().fit.candidate : selection.chosen.fit.candidate;
  std::size_t leading = 0;
  while (!causes.empty() && candidate.effects[leading].effect != causes.front().effect) ++leading;
  return run_drift(selection.problem.until(deadline), candidate, leading);
}

Gain gain_between(const Misfit& before, const Misfit& after) {
  return {before.relative_error, after.relative_error, before.noise_floor, before.numerical_error};
}

/// Largest deviation of the torque's timing, and the run it is in.
std::string largest_jitter(const Experiment& experiment, const TorqueTiming& timing) {
  double largest = 0.0;
  std::size_t run = 0;
  for (std::size_t r = 0; r < timing.late.size(); ++r) {
    if (timing.late[r].size() == 0) continue;
    const double late = timing.late[r].cwiseAbs().maxCoeff();
    if (late > largest) {
      largest = late;
      run = r;
    }
  }
  return fmt::format("up to {:.2g} % of a sampling period (run {})", 100.0 * largest,
                     experiment.runs[run].run.id);
}

void say_timing(const Experiment& experiment, const Selection& selection,
                std::vector<std::string>& notices) {
  if (selection.timing) {
    notices.push_back(fmt::format(
        "sampling jitter of the torque, {}, explains {:.0f} % of the excess residual and leaves "
        "noise: it is corrected, as a nuisance parameter",
        largest_jitter(experiment, *selection.timing), 100.0 * selection.timing->share));
  } else if (selection.undecided_timing) {
    notices.push_back(fmt::format(
        "undecided: sampling jitter of the torque, {}, would explain {:.0f} % of the excess "
        "residual but does not leave noise; it is not corrected",
        largest_jitter(experiment, *selection.undecided_timing),
        100.0 * selection.undecided_timing->share));
  }
}

/// Of the channels whose noise is coloured: how many, and how strong it is.
void say_noise(const Problem& problem, std::vector<std::string>& notices) {
  if (!problem.has_coloured_noise()) return;
  const auto& channels = problem.observations().channels;
  const auto is_coloured = [](const ObservedChannel& channel) {
    return channel.autoregression.order() > 0;
  };
  const auto strongest = std::ranges::max_element(
      channels, {},
      [&](const ObservedChannel& channel) { return is_coloured(channel) ? channel.noise : 0.0; });
  notices.push_back(fmt::format(
      "the noise of {} of {} channels is coloured, up to {:.3g} % of the signal ({} of run {}): an "
      "autoregressive model of it was fitted to residuals that depend on no effect of the library",
      std::ranges::count_if(channels, is_coloured), channels.size(), 100.0 * strongest->noise,
      strongest->sensor, problem.experiment().runs[strongest->run].run.id));
}

std::optional<DisturbanceGain> disturbance_gain(const Selection& selection) {
  const auto& before = selection.nothing.estimation.disturbance;
  const auto& after = selection.chosen.estimation.disturbance;
  if (!before || !after) return std::nullopt;
  const NoiseModel& noise = *selection.problem.predictor().noise();
  return DisturbanceGain{noise.correlation_time_s, before->estimated_N_m, after->estimated_N_m,
                         before->torque_rms_N_m, noise.modal_force_N_m};
}

/// By the torque hold, constant or linear between samples, that leaves the smaller error; where
/// both leave about as much, that with fewer causes.
Diagnosis with_nearest_hold(const Experiment& experiment, const std::vector<Hypothesis>& hypotheses,
                            const SelectionOptions& options, const DiagnosisProgress& progress) {
  constexpr double kAbout = 1.02;
  std::vector<Diagnosis> tried;
  for (const auto hold : {measured::TorqueHold::zero, measured::TorqueHold::first}) {
    const double begun = 0.5 * static_cast<double>(tried.size());
    SelectionOptions its_options = options;
    if (tried.empty()) its_options.deadline = halfway(options.deadline);
    tried.push_back(diagnose(with_hold(experiment, hold), hypotheses, its_options,
                             [&](std::string_view what, double done) {
                               return !progress || progress(what, begun + 0.5 * done);
                             }));
    Diagnosis& made = tried.back();
    if (made.cancelled) return made;
    made.notices.push_back(
        fmt::format("the files do not say what the torque does between samples: taken to be {}",
                    hold == measured::TorqueHold::zero ? "constant" : "linear"));
    if (made.verdict == Verdict::adequate || is_over(options.deadline)) return made;
  }
  // What one of the two did not search for, neither did both.
  if (!tried[0].search_end) tried[0].search_end = tried[1].search_end;
  if (!tried[1].search_end) tried[1].search_end = tried[0].search_end;
  const double ratio = tried[1].estimation.after / tried[0].estimation.after;
  if (ratio > kAbout) return tried[0];
  if (ratio < 1.0 / kAbout) return tried[1];
  return tried[1].causes.size() < tried[0].causes.size() ? tried[1] : tried[0];
}

/// Those that were fitted and not named, without those that cannot be simulated. Throws Cancelled
/// after the deadline.
std::vector<NearMiss> near_misses(const PredictedSelection& predicted, const Posterior& posterior,
                                  const Deadline& deadline) {
  const Selection& selection = predicted.selection;
  const Problem problem = predicted.simulated.until(deadline);
  std::vector<NearMiss> found;
  for (const auto* tried : {&selection.singles, &selection.combinations}) {
    for (const Explanation& one : *tried) {
      const Candidate& candidate = one.fit.candidate;
      if (candidate.labels() == selection.chosen.fit.candidate.labels()) continue;
      double error = one.estimation.relative_error;
      if (!is_simulation(predicted.predictor)) {
        const auto left = problem.residuals(candidate, problem.estimation_runs());
        if (!left) continue;
        error =
            misfit(problem.observations(), problem.experiment(), *left, problem.estimation_runs())
                .relative_error;
      }
      found.push_back({fmt::format("{}", fmt::join(candidate.labels(), " + ")),
                       posterior.of_set(candidate),
                       share_taken(selection.nothing.estimation, one.estimation),
                       lead(one, selection.nothing), error});
    }
  }
  std::ranges::stable_sort(found, [](const NearMiss& one, const NearMiss& other) {
    return std::pair(-one.probability, one.error) < std::pair(-other.probability, other.error);
  });
  // A set may be fitted more than once, from other values.
  std::set<std::string> met;
  std::erase_if(found, [&](const NearMiss& one) { return !met.insert(one.effects).second; });
  found.resize(std::min(kNearMisses, found.size()));
  return found;
}

}  // namespace

Diagnosis diagnose(const Experiment& experiment, const std::vector<Hypothesis>& all,
                   const SelectionOptions& options, const DiagnosisProgress& progress) {
  const bool is_by_motion = options.predictor == PredictorKind::driven_by_motion;
  if (!is_by_motion && !holds_are_known(experiment)) {
    return with_nearest_hold(experiment, all, options, progress);
  }
  const std::vector<Hypothesis> hypotheses = distinct(all);
  const PredictedSelection predicted =
      select_by_evidence(experiment, hypotheses, options, progress);
  const Selection& selection = predicted.selection;
  Diagnosis made;
  made.notices = experiment.notices;
  made.accepted = experiment.accepted;
  made.search_end = selection.end;
  made.cancelled = selection.cancelled;
  if (made.cancelled) return made;
  made.predictor = predicted.predictor;
  made.predictor_reason = predicted.reason;
  made.disturbance = disturbance_gain(selection);
  if (made.predictor == PredictorKind::torque_balance) {
    made.torque = selection.problem.has_validation_runs()
                      ? gain_between(selection.nothing.validation, selection.chosen.validation)
                      : gain_between(selection.nothing.estimation, selection.chosen.estimation);
  }
  const Candidate& chosen = selection.chosen.fit.candidate;
  const Posterior posterior = posterior_of(selection);
  const Deadline last = options.deadline ? *options.deadline + kReportTime : options.deadline;
  std::vector<std::string> left_out;
  const auto in_time = [&](const char* what, const auto& step) {
    try {
      require_time(last);
      step();
    } catch (const Cancelled&) {
      left_out.emplace_back(what);
    }
  };
  std::vector<double> errors;
  in_time("the truncation's share of the standard errors", [&] {
    errors =
        standard_errors(selection.problem.until(last), selection.chosen, options.further_modes);
  });
  if (errors.empty()) errors = standard_errors(selection.problem, selection.chosen, 0);
  made.causes = causes_of(selection, posterior, errors);
  made.something_else = posterior.of_something_else();
  say_timing(experiment, selection, made.notices);
  if (is_by_motion) {
    made.notices.push_back(
        motion_notice(selection.problem.experiment(), selection.problem.observations()));
  }
  say_noise(predicted.simulated, made.notices);
  // What is left is judged by simulation, whichever predictor found the effects, but for noise of
  // the recorded torque: a simulation adds it up.
  const Problem& problem = predicted.simulated;
  const Explanation as_filed = explain(problem, evaluated(problem, problem.as_filed()));
  const Explanation extended = is_simulation(made.predictor)
                                   ? selection.chosen
                                   : explain(problem, evaluated(problem, chosen));
  const bool is_by_filter = predicted.is_by_torque_noise();
  const Explanation& tested = is_by_filter ? selection.chosen : extended;
  made.verdict = verdict_of(tested, is_by_filter ? selection.nothing : as_filed,
                            made.search_end ? SearchState::incomplete : SearchState::complete);
  made.is_tested_by_filter = is_by_filter;
  made.estimation_test = tested.estimation_test;
  made.validation_test = tested.validation_test;
  made.converged = selection.chosen.fit.converged;
  made.evaluations = selection.chosen.fit.evaluations;
  arm::Arm arm_of_effects = chosen.extend(problem.experiment().arm);
  arm_of_effects.relative_uncertainties = experiment.arm.relative_uncertainties;
  if (predicted.balance && is_open(made.verdict)) {
    in_time("a law of the hub torque",
            [&] { made.empirical_law = predicted.law_beside_causes(last); });
  }
  made.extended_arm =
      made.empirical_law ? with_law(arm_of_effects, *made.empirical_law) : arm_of_effects;
  // Of all runs: those that were fitted and those that were held out.
  const Eigen::VectorXd residuals_before = as_filed.fit.residuals + as_filed.held_out;
  const Eigen::VectorXd residuals_of_effects = extended.fit.residuals + extended.held_out;
  Eigen::VectorXd residuals_after = residuals_of_effects;
  if (made.empirical_law) {
    const std::vector<bool> all_runs(problem.experiment().runs.size(), true);
    residuals_after = problem.residuals(made.extended_arm, chosen.nuisances, all_runs)
                          .value_or(residuals_of_effects);
  }
  const auto left = [&](const std::vector<bool>& runs) {
    return misfit(problem.observations(), problem.experiment(), residuals_after, runs);
  };
  made.estimation = gain_between(as_filed.estimation, left(problem.estimation_runs()));
  if (as_filed.validation.count > 0.0) {
    made.validation = gain_between(as_filed.validation, left(problem.validation_runs()));
  }
  made.channels = channel_gains(problem, residuals_before, residuals_after);
  const auto errors_of = [&problem](const Eigen::VectorXd& residuals) {
    return with_expected_errors(problem.observations(),
                                to_errors(problem.observations(), residuals));
  };
  const Eigen::VectorXd before = errors_of(residuals_before);
  const Eigen::VectorXd after = errors_of(residuals_after);
  const Eigen::VectorXd errors_of_effects = errors_of(residuals_of_effects);
  made.overlays = overlays(problem.observations(), before, after);
  std::optional<RunDrift> drift;
  in_time("the estimates of each run",
          [&] { drift = drift_of(selection, made.verdict, made.causes, last); });
  in_time("the symptoms", [&] {
    made.symptoms = symptoms_of({problem, before, after, chosen}, std::move(drift), last);
    if (!made.symptoms.is_complete) left_out.emplace_back("all symptoms");
  });
  if (predicted.balance && made.symptoms.hub_torque.terms.empty()) {
    // A simulation that runs away shows nothing of the torque that it lacks.
    auto& statements = made.symptoms.statements;
    std::erase_if(statements,
                  [](const Symptom& symptom) { return symptom.kind == SymptomKind::hub_torque; });
    statements.push_back(balance_symptom(*predicted.balance));
    sort_by_significance(statements);
  }
  made.refitted = refitted_numbers(problem.experiment().arm, chosen.nuisances, errors);
  if (is_open(made.verdict)) {
    in_time("the place of the missing force", [&] {
      made.missing_force = missing_force(problem, arm_of_effects, errors_of_effects, last);
    });
  }
  if (selection.problem.predictor().noise()) {
    in_time("the prediction errors", [&] {
      made.prediction_errors =
          prediction_errors(selection.problem.until(last), experiment.arm, made.extended_arm);
    });
  }
  made.posterior = posterior_sets(predicted, errors, options.further_modes, last);
  made.formulations = check_formulations(made.extended_arm, scales_of(experiment).sensors, last);
  if (is_open(made.verdict)) {
    in_time("the near misses", [&] { made.near_misses = near_misses(predicted, posterior, last); });
  }
  ReportedWork work(progress, options.deadline);
  try {
    made.next_experiments =
        what_next(selection.problem, selection, made.verdict != Verdict::unexplained, work);
  } catch (const Cancelled&) {
    made.cancelled = !work.is_out_of_time();
    left_out.emplace_back("the recommended runs");
  }
  if (!left_out.empty()) {
    made.notices.push_back(
        fmt::format("the time limit left no time for {}", fmt::join(left_out, ", ")));
  }
  return made;
}

}  // namespace flexarm::diagnose
