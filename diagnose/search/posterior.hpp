#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/selection_options.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Posterior probabilities of sets of causes, something else than the vocabulary included.
///
/// A set S of causes is right as far as it goes, and what it leaves is noise and the deviations of
/// something else, in estimation and validation runs. These deviations are a random function of few
/// degrees of freedom d and of unknown size, so that a set that leaves the excess sum of squares E
/// has the likelihood
///
///     -2 ln L(S) = d ln(1 + E/d)
///
/// instead of E: where no set leaves noise, sets differ by the ratio of what they leave, and a set
/// that removes part of a deviation of another kind gains little. E is beyond what the best set
/// leaves without its own excess (Misfit::excess). Where no set leaves noise, that excess is all
/// beyond the expectation of noise: the uncertainty of the noise level excuses none of it.
///
/// With a stochastic grey box, which has such a function for the hub torque, the likelihood is that
/// of the innovations, its logarithm times the part of them that is independent.
///
/// d = `kDiscrepancyFreedom` is small because one thing that is wrong moves a few frequencies,
/// damping ratios and amplitudes together.
///
/// The prior of a set is the product over its causes of one over the number of distinct hypotheses,
/// and, where what it leaves is not noise (residual_test.hpp),
/// SelectionOptions::prior_of_something_else. Names of the same model share its probability. Each
/// parameter costs `kParameterCost`. Sets that were not fitted, or whose parameters are not
/// identified, have probability 0.
class Posterior {
 public:
  /// `sets` must outlive the object: no cause, and sets of causes, each set once.
  Posterior(std::vector<const Explanation*> sets, std::size_t hypotheses,
            const SelectionOptions& options);
  /// Takes sets with scores (Explanation::score), whose probabilities are exp(-score/2) over the sum
  /// of these.
  explicit Posterior(const std::vector<const Explanation*>& scored_sets);

  /// Of all sets that have this cause; shared evenly with its `other_names`.
  double of(const Hypothesis& cause) const;
  /// Of all sets that have this cause, by whichever name, or one of `others` in its place.
  double of_any(const Hypothesis& cause, const std::vector<const Hypothesis*>& others) const;
  /// That something beyond the vocabulary is there, by itself or beside causes.
  double of_something_else() const;
  /// Of exactly this set; 0 where it is not among the sets.
  double of_set(const Candidate& candidate) const;

 private:
  struct Weighed {
    const Explanation* set;
    double probability;
    double cost;  ///< -2 ln of likelihood times prior, beyond the best set's
    bool is_complete;
  };
  /// Sets the probabilities from the costs, which are then beyond the best set's.
  void weigh();

  std::vector<Weighed> sets_;
};
inline constexpr double kDiscrepancyFreedom = 6.0;
/// -2 ln of what a parameter costs.
inline constexpr double kParameterCost = 4.0;

}  // namespace flexarm::diagnose
