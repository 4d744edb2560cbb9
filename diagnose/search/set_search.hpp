#pragma once

#include "diagnose/search/coarse_problems.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// Sets of several effects, one more at a time, on the beginning of the runs. Of several effects
/// that all shift frequencies none need be among the best by itself, and at the end of a lightly
/// damped record each set has many minima. In its first few periods the residuals are nearly linear
/// in the parameters, a score test tells which effects a set lacks, and a fit of few steps ends
/// near the values that all of the record has.
///
/// Sets of n effects are made of the best of n - 1, each with those effects that the score test
/// ranks first (additions.hpp), and fitted; on the early part, the best of which are refitted to
/// the coarse part, and on the coarse part, where effects show that need time. A set with a general
/// effect goes on where it leaves clearly less than the same set with a limit of that effect:
/// options.general_gain.
class SetSearch {
 public:
  /// Of `special` effects, and of `general` ones, which have another as a limit. The references
  /// must outlive the object.
  SetSearch(const CoarseProblems& parts, std::vector<const Hypothesis*> special,
            std::vector<const Hypothesis*> general, const SelectionOptions& options,
            ReportedWork& work)
      : parts_(parts),
        special_(std::move(special)),
        general_(std::move(general)),
        options_(options),
        work_(work) {}

  /// Begins with effects by themselves: `singles`, and those that the score test makes of
  /// `nothing`.
  void begin(const Candidate& nothing, const std::vector<Candidate>& singles);
  /// Fits the sets that it has once more, where parts have become longer.
  void refit();
  /// Sets of one effect more than before, fitted to the coarse part, the best first. As part of
  /// `what`, up to the fraction `to` of the work. Throws Cancelled where the work is cancelled.
  const std::vector<Fit>& grow(std::string_view what, double to);
  /// Part of what the best set left beyond noise on the coarse part that the effect which `grow`
  /// added last takes away.
  double share_taken() const { return share_taken_; }
  /// RMS value of what the best set leaves on the early part, in standard deviations of the noise.
  double rms_over_noise() const;
  /// `base` with each of the special effects that it lacks most, on the early part and on the
  /// coarse part, fitted to the coarse part; the best first.
  std::vector<Fit> beside(const Candidate& base, std::size_t most) const;

 private:
  /// A set that is to be fitted.
  struct Start {
    Candidate candidate;
    double expected = 0.0;  ///< sum of squares that the score test expects it to leave
    std::vector<Candidate> elsewhere = {};  ///< the same set at other values
    // Of a set with one effect more than a fitted one: where a fit from `candidate` leaves more
    // than that left, it went astray, and begins again beside the fitted set.
    Candidate near_base = {};
    double left_by_base = std::numeric_limits<double>::infinity();
  };

  /// `known`, which are fits to `part`, and of the best of `sets`, each with the effects that it
  /// lacks most, those that are expected to leave least, fitted; the best first, each set once.
  std::vector<Fit> larger(const Problem& part, const std::vector<Fit>& sets,
                          const SetGrowth& growth, std::vector<Fit> known = {}) const;
  /// The same on the coarse part, `looks` fitted to it being known. These alone where one of them
  /// leaves noise: others that do take the place of one of its effects, and are among exchanges.
  std::vector<Fit> larger_on_coarse(const std::vector<Candidate>& looks,
                                    const std::vector<Fit>& sets, const SetGrowth& growth) const;
  std::vector<Start> with_additions(const Problem& part, const Fit& set,
                                    const SetGrowth& growth) const;
  /// One a start.
  std::vector<Fit> fits(const Problem& part, const std::vector<Start>& starts) const;
  /// Each set once, without those that are not ahead of one with a limit of an effect; the best
  /// first.
  std::vector<Fit> fitted(const Problem& part, const std::vector<Candidate>& candidates) const;
  std::vector<Fit> ahead_of_limits(std::vector<Fit> sets) const;
  bool is_ahead_of_limits(const Fit& set, const std::vector<Fit>& sets) const;

  const CoarseProblems& parts_;
  std::vector<const Hypothesis*> special_;
  std::vector<const Hypothesis*> general_;
  const SelectionOptions& options_;
  ReportedWork& work_;
  std::vector<Fit> early_sets_ = {};
  std::vector<Fit> coarse_sets_ = {};
  double share_taken_ = 0.0;
};

}  // namespace flexarm::diagnose
