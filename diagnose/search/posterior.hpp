#pragma once

#include "diagnose/search/explanation.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Posterior probabilities of the sets of effects that were fitted, exp(-J/2) over the sum of
/// these, J their scores (scored_fit.hpp). Sets that were not fitted have probability 0.
class Posterior {
 public:
  /// `sets` must outlive the object: no effect, and sets of effects, each set once.
  explicit Posterior(const std::vector<const Explanation*>& sets);

  /// Returns the probability of the sets that have this cause, shared evenly with its
  /// `other_names`.
  double of(const Hypothesis& cause) const;
  /// Returns that of the sets that have this cause, by whichever name, or one of `others`.
  double of_any(const Hypothesis& cause, const std::vector<const Hypothesis*>& others) const;
  /// Returns that of the sets that do not leave noise: something beyond the vocabulary is there, by
  /// itself or beside causes.
  double of_something_else() const;
  /// Returns that of exactly this set; 0 where it is not among the sets.
  double of_set(const Candidate& candidate) const;

 private:
  struct Weighed {
    const Explanation* set;
    double probability;
  };

  std::vector<Weighed> sets_;
};

}  // namespace flexarm::diagnose
