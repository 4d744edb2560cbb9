#include "diagnose/diagnosis.hpp"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Inner steps a sample of the last refit.
constexpr int kFineSubsteps = 20;
/// No data make an effect more certain than this.
constexpr double kMostConfidence = 0.99;

/// Standard errors of all parameters of a fit: of the residuals' own size where that is above the
/// noise, for as many independent numbers as they are.
std::vector<double> standard_errors(const Fit& fit, const Misfit& misfit) {
  const Index n = fit.jacobian.cols();
  std::vector<double> errors(static_cast<std::size_t>(n));
  if (n == 0) return errors;
  const double scale = std::max(1.0, misfit.sum_of_squares / misfit.count) * misfit.count /
                       std::max(1.0, misfit.independent);
  const Eigen::MatrixXd information = fit.jacobian.transpose() * fit.jacobian;
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(n, n)) * scale;
  const Eigen::VectorXd places = fit.candidate.places();
  const auto parameters = fit.candidate.parameters();
  for (Index i = 0; i < n; ++i) {
    constexpr double kStep = 1e-6;
    const auto& parameter = parameters[static_cast<std::size_t>(i)];
    const double slope =
        (parameter.value(places(i) + kStep) - parameter.value(places(i) - kStep)) / (2.0 * kStep);
    errors[static_cast<std::size_t>(i)] =
        std::abs(slope) * std::sqrt(std::max(0.0, covariance(i, i)));
  }
  return errors;
}

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
    if (std::ranges::find(replaced->contains, cause.effect) != replaced->contains.end()) continue;
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
      fmt::format("It shows so: {}.", hypothesis.speaks_for)};
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

/// Of all runs, from what explanations left of those that were fitted and of the others.
std::vector<ChannelGain> channel_gains(const Problem& problem, const Explanation& nothing,
                                       const Explanation& chosen) {
  const Eigen::VectorXd before = nothing.fit.residuals + nothing.held_out;
  const Eigen::VectorXd after = chosen.fit.residuals + chosen.held_out;
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

/// The parameters of each effect of an explanation.
std::vector<std::vector<ParameterEstimate>> estimates_of(const Explanation& explanation) {
  const Candidate& candidate = explanation.fit.candidate;
  const std::vector<double> errors = standard_errors(explanation.fit, explanation.estimation);
  std::vector<std::vector<ParameterEstimate>> all;
  std::size_t at = 0;
  for (const Hypothesis& effect : candidate.effects) {
    auto& estimates = all.emplace_back();
    for (const auto& parameter : effect.parameters) {
      estimates.push_back(
          {parameter.name, candidate.values[at], errors[at], unit_of(effect, parameter)});
      ++at;
    }
  }
  return all;
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
  cause.refuted_by = effect.refuted_by;
  return cause;
}

Gain gain_between(const Misfit& before, const Misfit& after) {
  return {before.relative_error, after.relative_error, before.noise_floor};
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
  Problem problem(experiment);
  Selection selection = select(problem, hypotheses, options, progress);
  Diagnosis made;
  made.notices = experiment.notices;
  made.cancelled = selection.cancelled;
  if (made.cancelled) return made;
  const auto& found = selection.chosen.fit.candidate.effects;
  if (std::ranges::find(found, Shows::in_time, &Hypothesis::shows) != found.end()) {
    const Problem fine = problem.with_substeps(kFineSubsteps);
    selection.chosen = explain(fine, fit(fine, selection.chosen.fit.candidate));
  }

  const Candidate& chosen = selection.chosen.fit.candidate;
  const auto estimates = estimates_of(selection.chosen);
  for (std::size_t i = 0; i < chosen.effects.size(); ++i) {
    const Explanation without = chosen.effects.size() == 1
                                    ? selection.nothing
                                    : explain(problem, fit(problem, chosen.without(i)));
    Cause cause = cause_of(chosen.effects[i], selection, without);
    cause.parameters = estimates[i];
    made.causes.push_back(std::move(cause));
  }
  std::ranges::stable_sort(made.causes, std::ranges::greater{}, &Cause::share);

  made.verdict = verdict_of(selection, options);
  made.estimation = gain_between(selection.nothing.estimation, selection.chosen.estimation);
  if (selection.nothing.validation.count > 0.0) {
    made.validation = gain_between(selection.nothing.validation, selection.chosen.validation);
  }
  made.channels = channel_gains(problem, selection.nothing, selection.chosen);
  made.extended_arm = chosen.extend(experiment.arm);
  made.next_experiments = what_next(problem, selection, made.verdict != Verdict::unexplained);
  return made;
}

}  // namespace flexarm::diagnose
