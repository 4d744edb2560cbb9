#include "diagnose/diagnosis.hpp"

#include "arm/arm_keys.hpp"
#include "arm/uncertainties.hpp"
#include "diagnose/search/parameter_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Further modes beside which the error of leaving them out shows.
constexpr int kFurtherModes = 8;
/// Of those that were not named, as many are told.
constexpr std::size_t kNearMisses = 5;
/// No data make an effect more certain than this.
constexpr double kMostConfidence = 0.99;

/// What the rivals that lack an effect are in its place, with the information by which the chosen
/// causes lead them; the nearest first.
struct Rival {
  const Hypothesis* effect;
  double lead;
};

std::vector<Rival> rivals_of(const Hypothesis& cause, const Selection& selection) {
  std::vector<Rival> found;
  const Candidate& chosen = selection.chosen.fit.candidate;
  for (const Explanation& rival : selection.rivals) {
    const Candidate& other = rival.fit.candidate;
    if (other.has(cause)) continue;
    const auto replaced = std::ranges::find_if(
        other.effects, [&](const Hypothesis& effect) { return !chosen.has(effect); });
    if (replaced == other.effects.end()) continue;
    if (replaced->contains(cause.effect)) continue;
    found.push_back({&*replaced, lead(selection.chosen, rival)});
  }
  std::ranges::stable_sort(found, {}, &Rival::lead);
  return found;
}

std::vector<std::string> evidence_for(const Hypothesis& hypothesis, const Cause& cause,
                                      const std::vector<Rival>& rivals) {
  std::vector<std::string> evidence = {
      fmt::format("It takes away {:.1f} % of what is beyond noise without it.",
                  100.0 * cause.share),
      fmt::format("It shows so: {}.", hypothesis.entry->speaks_for)};
  if (!rivals.empty()) {
    const Rival& next = rivals.front();
    evidence.push_back(
        next.lead < kToldLead
            ? fmt::format("{} in its place does as well.", next.effect->label())
            : fmt::format("The next candidate in its place, {}, is {:.0f} of information behind.",
                          next.effect->label(), next.lead));
  }
  return evidence;
}

/// A candidate as it is, not fitted.
Fit evaluated(const Problem& problem, const Candidate& candidate) {
  Fit made{.candidate = candidate};
  if (const auto residuals = problem.residuals(candidate, problem.estimation_runs())) {
    made.residuals = *residuals;
  }
  return made;
}

std::vector<ChannelGain> channel_gains(const Problem& problem, const Eigen::VectorXd& before,
                                       const Eigen::VectorXd& after) {
  std::vector<ChannelGain> gains;
  const Observations& observations = problem.observations();
  const Experiment& experiment = problem.experiment();
  for (const ObservedChannel& channel : observations.channels) {
    gains.push_back({experiment.runs[channel.run].run.id,
                     channel.sensor,
                     {relative_error(observations, experiment, channel, before),
                      relative_error(observations, experiment, channel, after), channel.noise}});
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
/// something is wrong.
std::optional<RunDrift> drift_of(const Problem& problem, const Selection& selection,
                                 Verdict verdict, const std::vector<Cause>& causes) {
  const bool is_wrong = verdict == Verdict::unexplained && !selection.singles.empty();
  if (causes.empty() && !is_wrong) return std::nullopt;
  const Candidate& candidate =
      causes.empty() ? selection.singles.front().fit.candidate : selection.chosen.fit.candidate;
  std::size_t leading = 0;
  while (!causes.empty() && candidate.effects[leading].effect != causes.front().effect) ++leading;
  return run_drift(problem, candidate, leading);
}

/// The parameters of each effect of a candidate, with standard errors as `standard_errors` has
/// them.
std::vector<std::vector<ParameterEstimate>> estimates_of(const Candidate& candidate,
                                                         const std::vector<double>& errors) {
  std::vector<std::vector<ParameterEstimate>> all;
  std::size_t at = 0;
  for (const Hypothesis& effect : candidate.effects) {
    auto& estimates = all.emplace_back();
    for (const auto& parameter : effect.parameters) {
      estimates.push_back({parameter.name, candidate.values[at],
                           errors[candidate.nuisances.size() + at], effect.unit_of(parameter)});
      ++at;
    }
  }
  return all;
}

/// The uncertain numbers of the arm as a candidate has them.
std::vector<RefittedNumber> refitted_numbers(const arm::Arm& arm, const Candidate& candidate,
                                             const std::vector<double>& errors) {
  const arm::Arm refitted = arm::with_deviations(arm, candidate.nuisances);
  std::vector<RefittedNumber> numbers;
  for (const auto& [name, uncertainty] : arm.relative_uncertainties) {
    const auto& key = *std::ranges::find(arm::arm_keys(), name, &arm::ArmKey::name);
    const double value = *key.get(refitted);
    const double deviation = errors[numbers.size()];
    numbers.push_back(
        {name, *key.get(arm), uncertainty, value, value * uncertainty * deviation, key.unit});
  }
  return numbers;
}

/// A chosen effect but for its parameters; `without` is the choice without it.
Cause cause_of(const Hypothesis& effect, const Selection& selection, const Explanation& without) {
  Cause cause;
  cause.effect = effect.effect;
  cause.sensor = effect.sensor;
  cause.share = share_taken(without.estimation, selection.chosen.estimation);
  const std::vector<Rival> rivals = rivals_of(effect, selection);
  double odds = 0.0;
  for (const Rival& rival : rivals) {
    odds += std::exp(-0.5 * std::max(0.0, rival.lead));
    const std::string& name = rival.effect->effect;
    auto& confusable = cause.confusable_with;
    if (rival.lead < kToldLead && std::ranges::find(confusable, name) == confusable.end()) {
      confusable.push_back(name);
    }
  }
  cause.confidence = std::min(kMostConfidence, 1.0 / (1.0 + odds));
  cause.evidence = evidence_for(effect, cause, rivals);
  cause.refuted_by = effect.entry->refuted_by;
  return cause;
}

/// Where a parameter ends up outside the range that it was looked for in.
void say_beyond_range(const Hypothesis& effect, Cause& cause) {
  for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
    const SearchedParameter& searched = effect.parameters[i];
    const double place = searched.coordinate(cause.parameters[i].value);
    if (searched.periodic || (place >= 0.0 && place <= 1.0)) continue;
    cause.evidence.push_back(
        fmt::format("Its {} is outside the range that was searched, {:.3g} to {:.3g} {}: what it "
                    "stands for may be something else.",
                    searched.name, searched.lowest, searched.highest, cause.parameters[i].unit));
  }
}

Gain gain_between(const Misfit& before, const Misfit& after) {
  return {before.relative_error, after.relative_error, before.noise_floor};
}

/// "the torque acts up to 5 % of a sampling period off its time, most in run multisine: ..."
std::string timing_notice(const Experiment& experiment, const TorqueTiming& timing) {
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
  return fmt::format(
      "the torque acts up to {:.2g} % of a sampling period before or after its samples, most so in "
      "run {}: this explains {:.0f} % of what was left beyond noise, and is corrected",
      100.0 * largest, experiment.runs[run].run.id, 100.0 * timing.share);
}

/// By the torque hold, constant or linear between samples, that leaves the smaller error; where
/// both leave about as much, that with fewer causes.
Diagnosis with_nearest_hold(const Experiment& experiment, const std::vector<Hypothesis>& hypotheses,
                            const SelectionOptions& options, const DiagnosisProgress& progress) {
  constexpr double kAbout = 1.02;
  std::vector<Diagnosis> tried;
  for (const auto hold : {measured::TorqueHold::zero, measured::TorqueHold::first}) {
    const double begun = 0.5 * static_cast<double>(tried.size());
    tried.push_back(diagnose(with_hold(experiment, hold), hypotheses, options,
                             [&](std::string_view what, double done) {
                               return !progress || progress(what, begun + 0.5 * done);
                             }));
    Diagnosis& made = tried.back();
    if (made.cancelled) return made;
    made.notices.push_back(
        fmt::format("the files do not say what the torque does between samples: taken to be {}",
                    hold == measured::TorqueHold::zero ? "constant" : "linear"));
    if (made.verdict == Verdict::adequate) return made;
  }
  const double ratio = tried[1].estimation.after / tried[0].estimation.after;
  if (ratio > kAbout) return tried[0];
  if (ratio < 1.0 / kAbout) return tried[1];
  return tried[1].causes.size() < tried[0].causes.size() ? tried[1] : tried[0];
}

std::vector<NearMiss> near_misses(const Selection& selection) {
  std::vector<NearMiss> found;
  for (const auto* tried : {&selection.singles, &selection.combinations}) {
    for (const Explanation& one : *tried) {
      found.push_back({one.fit.candidate.label(),
                       share_taken(selection.nothing.estimation, one.estimation),
                       lead(one, selection.nothing), one.estimation.relative_error});
    }
  }
  std::ranges::stable_sort(found, {}, &NearMiss::error);
  found.resize(std::min(kNearMisses, found.size()));
  return found;
}

Verdict verdict_of(const Selection& selection, const SelectionOptions& options) {
  const bool is_enough =
      is_explained(selection.chosen.estimation, selection.nothing.estimation, options);
  if (!selection.chosen.fit.candidate.effects.empty()) {
    return is_enough ? Verdict::explained : Verdict::partly_explained;
  }
  return is_enough ? Verdict::adequate : Verdict::unexplained;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate:
      return "adequate";
    case Verdict::explained:
      return "explained";
    case Verdict::partly_explained:
      return "partly_explained";
    case Verdict::unexplained:
      return "unexplained";
  }
  return "";
}

Diagnosis diagnose(const Experiment& experiment, const std::vector<Hypothesis>& hypotheses,
                   const SelectionOptions& options, const DiagnosisProgress& progress) {
  if (!holds_are_known(experiment)) {
    return with_nearest_hold(experiment, hypotheses, options, progress);
  }
  const Selection selection = select(Problem(experiment), hypotheses, options, progress);
  const Problem& problem = selection.problem;
  Diagnosis made;
  made.notices = experiment.notices;
  made.cancelled = selection.cancelled;
  if (made.cancelled) return made;
  const Candidate& chosen = selection.chosen.fit.candidate;
  const std::vector<double> errors =
      standard_errors(problem, selection.chosen,
                      problem.with_modes(problem.predictor().flexible_modes() + kFurtherModes));
  const auto estimates = estimates_of(chosen, errors);
  for (std::size_t i = 0; i < chosen.effects.size(); ++i) {
    const Explanation without = chosen.effects.size() == 1
                                    ? selection.nothing
                                    : explain(problem, fit(problem, chosen.without(i)));
    Cause cause = cause_of(chosen.effects[i], selection, without);
    cause.parameters = estimates[i];
    say_beyond_range(chosen.effects[i], cause);
    made.causes.push_back(std::move(cause));
  }
  std::ranges::stable_sort(made.causes, std::ranges::greater{}, &Cause::share);

  if (selection.timing) made.notices.push_back(timing_notice(experiment, *selection.timing));
  made.verdict = verdict_of(selection, options);
  const Explanation as_filed = explain(problem, evaluated(problem, problem.as_filed()));
  made.estimation = gain_between(as_filed.estimation, selection.chosen.estimation);
  if (as_filed.validation.count > 0.0) {
    made.validation = gain_between(as_filed.validation, selection.chosen.validation);
  }
  // Of all runs: those that were fitted and those that were held out.
  const Eigen::VectorXd before = as_filed.fit.residuals + as_filed.held_out;
  const Eigen::VectorXd after = selection.chosen.fit.residuals + selection.chosen.held_out;
  made.channels = channel_gains(problem, before, after);
  made.overlays = overlays(problem.observations(), before, after);
  made.symptoms = symptoms_of({problem, before, after, chosen},
                              drift_of(problem, selection, made.verdict, made.causes));
  made.refitted = refitted_numbers(experiment.arm, chosen, errors);
  made.extended_arm = chosen.extend(experiment.arm);
  made.formulations = check_formulations(made.extended_arm, scales_of(experiment).sensors);
  if (made.verdict == Verdict::unexplained || made.verdict == Verdict::partly_explained) {
    made.near_misses = near_misses(selection);
  }
  made.next_experiments = what_next(problem, selection, made.verdict != Verdict::unexplained);
  return made;
}

}  // namespace flexarm::diagnose
