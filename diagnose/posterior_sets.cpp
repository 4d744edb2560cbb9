#include "diagnose/posterior_sets.hpp"

#include "diagnose/cause.hpp"
#include "diagnose/search/parameter_errors.hpp"
#include "diagnose/search/rivals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// From zero, and for the reciprocal from infinity, coordinates are in equal ratios beyond
/// `lowest`.
bool is_in_ratio(const SearchedParameter& parameter, double value) {
  switch (parameter.spacing) {
    case effects::Spacing::linear:
      return false;
    case effects::Spacing::logarithmic:
      return true;
    case effects::Spacing::from_zero:
      return value >= parameter.lowest;
    case effects::Spacing::about_zero:
      return value >= -parameter.lowest;
    case effects::Spacing::from_infinity:
      return value <= parameter.highest;
  }
  return false;
}

/// Returns the set of a fit with these standard errors, without its probability. The numbers first,
/// as the fit has them.
PosteriorSet set_of(const Problem& problem, const Explanation& explanation,
                    const std::vector<double>& errors) {
  const Candidate& candidate = explanation.fit.candidate;
  PosteriorSet made;
  if (errors.empty()) return made;
  for (const RefittedNumber& number :
       refitted_numbers(problem.experiment().arm, candidate.nuisances, errors)) {
    made.parameters.push_back({number.key, number.value, number.std_error, number.unit, true});
  }
  std::size_t at = 0;
  for (const Hypothesis& effect : candidate.effects) {
    made.effects.push_back({effect.effect, effect.sensor});
    for (const SearchedParameter& parameter : effect.parameters) {
      const double value = candidate.values[at];
      // A part above another number is in the ratio of neither.
      const bool is_logarithmic =
          value > 0.0 && !parameter.above_previous && is_in_ratio(parameter, value);
      made.parameters.push_back({fmt::format("effects.{}.{}", effect.effect, parameter.name), value,
                                 errors[candidate.nuisances.size() + at], effect.unit_of(parameter),
                                 is_logarithmic});
      ++at;
    }
  }
  made.correlation = correlation_of_estimates(explanation);
  return made;
}

/// With the parameters of its effects first.
PosteriorSet with_effects_first(PosteriorSet set, std::size_t numbers) {
  const auto count = static_cast<Index>(set.parameters.size());
  std::rotate(set.parameters.begin(), set.parameters.begin() + static_cast<std::ptrdiff_t>(numbers),
              set.parameters.end());
  Eigen::MatrixXd moved(count, count);
  const auto shift = static_cast<Index>(numbers);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < count; ++j) {
      moved(i, j) = set.correlation((i + shift) % count, (j + shift) % count);
    }
  }
  set.correlation = std::move(moved);
  return set;
}

bool is_whole(const PosteriorSet& set) {
  const auto is_known = [](const PosteriorParameter& parameter) {
    return std::isfinite(parameter.value) && std::isfinite(parameter.std_error);
  };
  return std::ranges::all_of(set.parameters, is_known) && set.correlation.allFinite();
}

}  // namespace

std::vector<PosteriorSet> posterior_sets(const PredictedSelection& predicted,
                                         const std::vector<double>& errors_of_chosen,
                                         int further_modes, const Deadline& deadline) {
  const Selection& selection = predicted.selection;
  const Problem in_time = selection.problem.until(deadline);
  const Posterior posterior = posterior_of(selection);
  std::vector<PosteriorSet> sets;
  std::set<std::set<std::string>> seen = {selection.chosen.fit.candidate.labels()};
  const auto add = [&](const Explanation& explanation, double probability,
                       const std::vector<double>& errors) {
    const Candidate& candidate = explanation.fit.candidate;
    PosteriorSet made = set_of(selection.problem, explanation, errors);
    if (made.parameters.empty() && !candidate.effects.empty()) return;
    const std::size_t numbers = made.parameters.empty() ? 0 : candidate.nuisances.size();
    made.probability = probability;
    if (is_whole(made)) sets.push_back(with_effects_first(std::move(made), numbers));
  };
  const double of_chosen = posterior.of_set(selection.chosen.fit.candidate);
  add(selection.chosen, of_chosen > 0.0 ? of_chosen : 1.0, errors_of_chosen);
  std::vector<std::pair<double, const Explanation*>> others;
  for (const auto* tried : {&selection.singles, &selection.combinations}) {
    for (const Explanation& one : *tried) {
      const double probability = posterior.of_set(one.fit.candidate);
      if (probability >= kLeastSetProbability) others.emplace_back(probability, &one);
    }
  }
  std::ranges::stable_sort(others, std::ranges::greater{}, &decltype(others)::value_type::first);
  try {
    for (const auto& [probability, one] : others) {
      require_time(deadline);
      if (!seen.insert(one->fit.candidate.labels()).second) continue;
      add(*one, probability, standard_errors(in_time, *one, further_modes));
    }
  } catch (const Cancelled&) {
    // The sets so far.
  }
  double sum = 0.0;
  for (const PosteriorSet& set : sets) sum += set.probability;
  for (PosteriorSet& set : sets) set.probability /= sum;
  return sets;
}

}  // namespace flexarm::diagnose
