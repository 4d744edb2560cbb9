#include "diagnose/search/posterior.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

Posterior::Posterior(const std::vector<const Explanation*>& sets) {
  const double least = (*std::ranges::min_element(sets, {}, &Explanation::score))->score;
  double sum = 0.0;
  for (const Explanation* set : sets) {
    sets_.push_back({set, std::exp(-0.5 * (set->score - least))});
    sum += sets_.back().probability;
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
    if (!weighed.set->leaves_noise()) sum += weighed.probability;
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
