#include "diagnose/search/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::diagnose {

namespace {

/// -2 ln of the likelihood of a set that leaves this excess over the `best`. With a stochastic grey
/// box deviations are part of the model, and the likelihood is that of the innovations, by the
/// independent numbers among those of the best.
double cost_of_excess(double excess, const Misfit& best) {
  if (best.disturbance) return excess * best.independent / best.count;
  return kDiscrepancyFreedom * std::log1p(excess / kDiscrepancyFreedom);
}

/// Of all runs, with those of the arm's uncertain numbers: what a set leaves, and what is expected
/// of noise.
double squares_of(const Explanation& set) {
  return set.estimation.minus_two_log_likelihood() + set.validation.minus_two_log_likelihood() +
         set.estimation.nuisance_squares;
}
double squares_of_noise(const Explanation& set) {
  return set.estimation.count + set.validation.count + set.estimation.nuisances;
}

}  // namespace

Posterior::Posterior(std::vector<const Explanation*> sets, std::size_t hypotheses,
                     const SelectionOptions& options) {
  const auto best_set =
      std::ranges::min_element(sets, {}, [](const Explanation* set) { return squares_of(*set); });
  double least = squares_of(**best_set);
  const bool has_known_noise = !(*best_set)->estimation.disturbance;
  if (has_known_noise) {
    least -= (*best_set)->estimation.excess() + (*best_set)->validation.excess();
  }
  if (has_known_noise && std::ranges::none_of(sets, &Explanation::leaves_noise)) {
    least = std::min(least, squares_of_noise(**best_set));
  }
  const double cost_of_cause = 2.0 * std::log(static_cast<double>(hypotheses));
  const double cost_of_else = -2.0 * std::log(options.prior_of_something_else);
  for (const Explanation* set : sets) {
    const Candidate& candidate = set->fit.candidate;
    const double excess = std::max(0.0, squares_of(*set) - least);
    const bool is_complete = set->leaves_noise();
    const double cost = cost_of_excess(excess, (*best_set)->estimation) +
                        cost_of_cause * static_cast<double>(candidate.effects.size()) +
                        kParameterCost * static_cast<double>(candidate.values.size()) +
                        (is_complete ? 0.0 : cost_of_else);
    sets_.push_back({set, 0.0, cost, is_complete});
  }
  weigh();
}

Posterior::Posterior(const std::vector<const Explanation*>& scored_sets) {
  for (const Explanation* set : scored_sets) {
    sets_.push_back({set, 0.0, *set->score, set->leaves_noise()});
  }
  weigh();
}

void Posterior::weigh() {
  const double best = std::ranges::min(sets_, {}, &Weighed::cost).cost;
  double sum = 0.0;
  for (Weighed& weighed : sets_) {
    weighed.cost -= best;
    weighed.probability = std::exp(-0.5 * weighed.cost);
    sum += weighed.probability;
  }
  for (Weighed& weighed : sets_) weighed.probability /= sum;
}

double Posterior::of(const Hypothesis& cause) const {
  return of_any(cause, {}) / static_cast<double>(1 + cause.other_names.size());
}

double Posterior::of_any(const Hypothesis& cause,
                         const std::vector<const Hypothesis*>& others) const {
  double sum = 0.0;
  for (const Weighed& weighed : sets_) {
    const Candidate& candidate = weighed.set->fit.candidate;
    const bool has_one =
        candidate.has(cause) ||
        std::ranges::any_of(others, [&](const Hypothesis* other) { return candidate.has(*other); });
    if (has_one) sum += weighed.probability;
  }
  return std::min(1.0, sum);
}

double Posterior::of_something_else() const {
  double sum = 0.0;
  for (const Weighed& weighed : sets_) {
    if (!weighed.is_complete) sum += weighed.probability;
  }
  return std::min(1.0, sum);
}

double Posterior::of_set(const Candidate& candidate) const {
  const auto found = std::ranges::find_if(sets_, [&](const Weighed& weighed) {
    return weighed.set->fit.candidate.labels() == candidate.labels();
  });
  return found == sets_.end() ? 0.0 : found->probability;
}

}  // namespace flexarm::diagnose
