#include "diagnose/cause.hpp"

#include "arm/arm_keys.hpp"
#include "arm/effect_label.hpp"
#include "arm/uncertainties.hpp"
#include "diagnose/search/rivals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::diagnose {

namespace {

std::string odds_text(double odds) {
  constexpr double kMillion = 1e6;
  return odds > kMillion ? std::string("more than a million") : fmt::format("{:.2g}", odds);
}

std::vector<std::string> evidence_for(const Hypothesis& hypothesis, double share,
                                      bool is_of_disturbance, const std::vector<Rival>& rivals,
                                      double most_odds) {
  std::vector<std::string> evidence = {
      share > 0.0
          ? fmt::format(
                "It explains {:.1f} % of the {} that is left without it.", 100.0 * share,
                is_of_disturbance ? "variance of the unrecorded hub torque" : "excess residual")
          : "It does not reduce the residuals that are left without it.",
      fmt::format("Its signature: {}.", hypothesis.entry->speaks_for)};
  if (!hypothesis.other_names.empty()) {
    evidence.push_back(fmt::format("The same model as {}: no data distinguish them.",
                                   fmt::join(hypothesis.other_names, ", ")));
  }
  if (rivals.empty()) return evidence;
  const Rival& next = rivals.front();
  evidence.push_back(
      next.odds <= most_odds
          ? fmt::format("Indistinguishable from {} in these data (posterior odds {}).",
                        next.effect->label(), odds_text(next.odds))
          : fmt::format("With {} in its place the fit is worse: posterior odds {} to 1, delta BIC "
                        "{:.3g}.",
                        next.effect->label(), odds_text(next.odds), next.delta_bic));
  return evidence;
}

/// The parameters of the effect at `index`.
std::vector<ParameterEstimate> estimates_of(const Candidate& candidate, std::size_t index,
                                            const std::vector<double>& errors) {
  std::size_t at = candidate.values_before(index);
  std::vector<ParameterEstimate> estimates;
  const Hypothesis& effect = candidate.effects[index];
  for (const auto& parameter : effect.parameters) {
    estimates.push_back({parameter.name, candidate.values[at],
                         errors[candidate.nuisances.size() + at], effect.unit_of(parameter)});
    ++at;
  }
  return estimates;
}

Cause cause_of(const Selection& selection, std::size_t index, const Posterior& posterior,
               const std::vector<double>& errors) {
  const Candidate& chosen = selection.chosen.fit.candidate;
  const Hypothesis& effect = chosen.effects[index];
  // Where no time was left to refit the others, they are held.
  const Explanation without =
      !selection.without.empty() ? selection.without[index]
      : chosen.effects.size() == 1
          ? selection.nothing
          : explain(selection.problem, evaluated(selection.problem, chosen.without(index)));
  const Policy& policy = selection.problem.policy();
  Cause cause;
  cause.effect = effect.effect;
  cause.sensor = effect.sensor;
  cause.parameters = estimates_of(chosen, index, errors);
  cause.is_at_end_of_range = effect.is_at_end_of_range(chosen.values_of(index));
  cause.share = share_taken(without.estimation, selection.chosen.estimation);
  cause.confidence = posterior.of(effect);
  const std::vector<Rival> rivals = rivals_of(effect, selection, posterior);
  cause.class_confidence = class_probability(effect, rivals, posterior, policy.odds);
  auto& confusable = cause.confusable_with;
  confusable = effect.other_names;
  const auto add = [&confusable](const std::string& name) {
    if (std::ranges::find(confusable, name) == confusable.end()) confusable.push_back(name);
  };
  std::size_t of_family = 0;
  std::size_t of_others = 0;
  for (const Rival& rival : rivals) {
    if (rival.odds > policy.odds) break;
    ++(rival.effect->entry->family == effect.entry->family ? of_family : of_others);
    // Of the same effect it is another sensor.
    add(rival.effect->effect == effect.effect ? rival.effect->label() : rival.effect->effect);
    std::ranges::for_each(rival.effect->other_names, add);
  }
  cause.family = to_string(effect.entry->family);
  cause.names_family = of_family > 0 && of_others == 0;
  if (!selection.evidence.empty()) {
    cause.figures = selection.evidence[index];
    cause.grade = cause.is_at_end_of_range ? Grade::candidate
                                           : grade_of(*cause.figures, of_others > 0,
                                                      selection.chosen.leaves_noise(), policy);
  }
  cause.evidence = evidence_for(effect, cause.share, without.estimation.disturbance.has_value(),
                                rivals, policy.odds);
  if (cause.is_at_end_of_range) {
    cause.evidence.push_back(fmt::format("Its {} is at the end of the range that is searched.",
                                         effect.parameters[*effect.size_parameter()].name));
  }
  cause.refuted_by = effect.entry->refuted_by;
  return cause;
}

}  // namespace

std::string Cause::label() const {
  return arm::effect_label(effect, sensor);
}

bool RefittedNumber::has_moved() const {
  return std::abs(value - file_value) > kMoved * std_error;
}

std::vector<Cause> causes_of(const Selection& selection, const Posterior& posterior,
                             const std::vector<double>& errors) {
  std::vector<Cause> causes;
  for (std::size_t i = 0; i < selection.chosen.fit.candidate.effects.size(); ++i) {
    causes.push_back(cause_of(selection, i, posterior, errors));
  }
  std::ranges::stable_sort(causes, std::ranges::greater{}, &Cause::share);
  return causes;
}

std::vector<RefittedNumber> refitted_numbers(const arm::Arm& arm,
                                             const std::vector<double>& deviations,
                                             const std::vector<double>& errors) {
  const arm::Arm refitted = arm::with_deviations(arm, deviations);
  std::vector<RefittedNumber> numbers;
  for (const auto& [name, uncertainty] : arm.relative_uncertainties) {
    const auto& key = *std::ranges::find(arm::arm_keys(), name, &arm::ArmKey::name);
    const double value = *key.get(refitted);
    const std::size_t i = numbers.size();
    numbers.push_back({name, *key.get(arm), uncertainty, value, value * uncertainty * errors[i],
                       key.unit, deviations[i]});
  }
  return numbers;
}

}  // namespace flexarm::diagnose
