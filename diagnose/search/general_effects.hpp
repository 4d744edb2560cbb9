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
  /// The references must outlive the object.
  GeneralEffects(const std::vector<Hypothesis>& hypotheses, const SelectionOptions& options,
                 SetFits& fits);

  const std::vector<const Hypothesis*>& all() const { return general_; }
  /// The special ones: the rest of the hypotheses.
  const std::vector<const Hypothesis*>& others() const { return special_; }
  bool has(const Hypothesis& effect) const;
  /// Those that have this effect as a limit.
  std::vector<const Hypothesis*> with_limit(const Hypothesis& effect) const;

  /// By themselves, when made.singles are those of the others: all if none of these leaves noise,
  /// else those of which a limit does. By EffectScan::share_of_law, laws of hub torque below
  /// options.least_law_share are left out, and those of options.least_share or more are tried
  /// before the rest. The rest is left out where nothing left noise before and one of these does.
  /// Each is looked for from the best of its limits, too, and is fitted to all data where it leaves
  /// no more than the best of the others (options.largest_of_general), of the early part first, and
  /// is ahead of that limit (options.general_gain). Where that limit leaves noise, it is looked for
  /// from there alone, and a fit ends where it cannot leave less than the limit by half of
  /// options.least_information_gain. Adds to made.singles; `what` and `to` as in
  /// SetFits::add_all. What is left out is added to made.ruled_out. Throws Cancelled;
  /// SetFits::untried then has the labels of all that were not fitted.
  void try_by_themselves(Selection& made, std::string_view what, double to);

  /// One that was not tried may be the cause: `single`, a limit of it, does not leave noise.
  bool may_be_behind(const Explanation& single) const;

 private:
  std::vector<const Hypothesis*> worth_trying(const std::vector<Explanation>& special) const;
  /// Of a part of the data, what no effect leaves, and the least sum of squares that the best of
  /// the special ones leave.
  struct LeftOfPart {
    Fit by_none;
    double least = 0.0;
  };
  struct LeftOfParts {
    std::optional<LeftOfPart> early = {};  ///< empty where no part is earlier
    LeftOfPart coarse;
  };
  /// Empty where there are no special ones.
  std::optional<LeftOfParts> left_of_parts(const Candidate& none,
                                           const std::vector<Explanation>& special) const;
  /// Where a fit to all data begins, or what rules the effect out: it leaves more than the best of
  /// the special ones, of one part or the other, or is not ahead of its limit.
  struct Look {
    std::optional<SetFits::Start> start = {};
    double share = 0.0;  ///< RuledOut::share, without a start
  };
  Look near_look(const Candidate& none, const std::vector<Explanation>& special,
                 const std::optional<LeftOfParts>& left, const Hypothesis& general) const;

  const std::vector<Hypothesis>& hypotheses_;
  const SelectionOptions& options_;
  SetFits& fits_;
  std::vector<const Hypothesis*> general_;
  std::vector<const Hypothesis*> special_;
  bool are_tried_ = false;  // by themselves
};

}  // namespace flexarm::diagnose
