#pragma once

#include "diagnose/search/selection.hpp"
#include "diagnose/search/set_fits.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// The effects of a search that have another one of it as a limit. They are named for what they add
/// to that one: by themselves they are tried behind the others, from where their limits are.
class GeneralEffects {
 public:
  /// The references must outlive the object; the problem may change in between.
  GeneralEffects(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, SetFits& fits);

  const std::vector<const Hypothesis*>& all() const { return general_; }
  /// The special ones: the rest of the hypotheses.
  const std::vector<const Hypothesis*>& others() const { return special_; }
  bool has(const Hypothesis& effect) const;

  /// By themselves, when made.singles are those of the others: all if none of these leaves noise,
  /// else those of which a limit does. By EffectScan::share_of_law, laws of hub torque below
  /// options.least_law_share are left out, and those of options.least_share or more are tried
  /// before the rest. The rest is left out where nothing left noise before and one of these does.
  /// Each is looked for from the best of its limits, too, and is fitted to all data where it is
  /// near to the best of the others (options.largest_of_looks), on the early part first. Adds to
  /// made.singles; `what` and `to` as in SetFits::add_all. Throws Cancelled; SetFits::untried then
  /// has the labels of all that were not fitted.
  void try_by_themselves(Selection& made, std::string_view what, double to);

  /// One that was not tried may be the cause: `single`, a limit of it, does not leave noise.
  bool may_be_behind(const Explanation& single) const;

 private:
  std::vector<const Hypothesis*> worth_trying(const std::vector<Explanation>& special) const;
  /// Of the best of the special ones, on the early part of the data; empty where there are none, or
  /// no part is earlier.
  std::optional<double> least_early_sum(const std::vector<Explanation>& special) const;
  /// Empty where it is far from the best of the special ones, on the early part, where these leave
  /// `early_sum`, or on all data.
  std::optional<Candidate> near_look(const Candidate& none, const std::vector<Explanation>& special,
                                     const std::optional<double>& early_sum,
                                     const Hypothesis& general) const;

  const Problem& problem_;
  const std::vector<Hypothesis>& hypotheses_;
  const SelectionOptions& options_;
  SetFits& fits_;
  std::vector<const Hypothesis*> general_;
  std::vector<const Hypothesis*> special_;
  bool are_tried_ = false;  // by themselves
};

}  // namespace flexarm::diagnose
