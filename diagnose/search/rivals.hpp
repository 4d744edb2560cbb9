#pragma once

#include "diagnose/search/posterior.hpp"
#include "diagnose/search/selection.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// What stands in place of a chosen cause in a set that was fitted as well.
struct Rival {
  const Hypothesis* effect = nullptr;
  double odds = 0.0;       ///< of the chosen set over that set, by the posterior
  double delta_bic = 0.0;  ///< of that set beyond the chosen one (misfit.hpp)
};

/// One that has another effect in the place of one of the other's.
bool is_rival(const Candidate& one, const Candidate& other);

/// Returns whether it has a limit in the place of an effect of the other's (Hypothesis::contains).
bool is_limit(const Candidate& one, const Candidate& other);

/// The rivals of a cause among the sets that were fitted, the nearest first; one that has the cause
/// as a limit is none. Pointers are into `selection`.
std::vector<Rival> rivals_of(const Hypothesis& cause, const Selection& selection,
                             const Posterior& posterior);

/// The sets of the rivals that are indistinguishable: of odds <= Policy::odds.
std::vector<Explanation> indistinguishable_sets(const Selection& selection,
                                                const Posterior& posterior);

/// Returns the posterior of the sets that were fitted: no cause, the chosen one, singles and
/// combinations.
Posterior posterior_of(const Selection& selection);

/// Returns the probability that this cause, or one of its `rivals` of odds <= `most_odds`, is
/// there. A rival that is better by more than that, which could not be named, says nothing for it.
double class_probability(const Hypothesis& cause, const std::vector<Rival>& rivals,
                         const Posterior& posterior, double most_odds);

}  // namespace flexarm::diagnose
