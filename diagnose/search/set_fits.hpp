#pragma once

#include "diagnose/search/coarse_problems.hpp"
#include "diagnose/search/effect_scan.hpp"
#include "diagnose/search/explanation.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// Sets of effects fitted to all data of a problem, many at a time. Throws Cancelled where the work
/// is cancelled or its time is over; what had been fitted by then is kept.
class SetFits {
 public:
  /// The references must outlive the object; the problem may change in between.
  SetFits(const Problem& problem, const SelectionOptions& options, ReportedWork& work)
      : problem_(problem),
        options_(options),
        work_(work),
        parts_(problem, options),
        scan_(parts_, options, work) {}

  const CoarseProblems& parts() const { return parts_; }
  const EffectScan& scan() const { return scan_; }
  /// CoarseProblems::lengthen, for what `left` leaves.
  bool lengthen_parts(const Explanation& left) {
    return parts_.lengthen(problem_, left.fit.residuals);
  }

  /// From the candidate's own values.
  Explanation fitted(const Candidate& start) const;

  /// Adds to `found` `base` with each of `others` that it has not, found by a scan of a coarse
  /// problem; the tried.refitted best of these fitted to all data, beside effects of `base` those
  /// that are near the best (is_near). Beside effects of `base` the tried.looks most promising are
  /// scanned (EffectScan::promising), else all. As part of `what`, up to the fraction `to` of the
  /// work. Of effects by themselves, returns the looks that were not fitted, or not to the end as
  /// they are out of the question (highest_of_use), the best first.
  std::vector<Fit> add_with(const Candidate& base, std::vector<const Hypothesis*> others,
                            std::string_view what, double to, const Tried& tried,
                            std::vector<Explanation>& found);

  /// Adds to `found` `base` with each of the tried.looks of `others` that it lacks most, by score
  /// tests without scans (SetSearch::beside); the tried.refitted best of these fitted to all data
  /// where they come near the best. As part of `what`, up to the fraction `to` of the work.
  void add_beside(const Candidate& base, const std::vector<const Hypothesis*>& others,
                  std::string_view what, double to, const Tried& tried,
                  std::vector<Explanation>& found);
  /// Adds to `found` looks, which are sorted by fit, fitted to all data: `most` or less, and where
  /// the best does not leave noise options.far_sets_refitted or less, that come near the best
  /// (is_near), and are not in `found`, or are there without leaving noise where the best look
  /// does. Those with more parameters than the best look are fitted behind the others. Each is
  /// fitted as far as it may be of use (highest_of_use).
  void add_near(std::vector<Fit> looks, std::size_t most, std::string_view what, double to,
                std::vector<Explanation>& found);

  /// Where a fit begins, and the sum of squares that it must come below to be of use.
  struct Start {
    Candidate candidate;
    double highest_minimum = std::numeric_limits<double>::infinity();
  };
  /// Fits start(i) for the i-th of `sets`, which are their labels, and adds those that are
  /// identified, and come below start(i).highest_minimum, to `found`, the best first. Sets of
  /// several effects are added without those that are not identified. Of the same set, begun from
  /// another, the better stays. Where start(i) is empty, that set needs no fit. Returns which
  /// those are, and which do not come below their highest_minimum.
  std::vector<std::size_t> add_all(std::vector<std::string> sets, std::string_view what, double to,
                                   std::vector<Explanation>& found,
                                   const std::function<std::optional<Start>(std::size_t)>& start);

  /// Labels of the sets that were to be added last and were not fitted.
  const std::vector<std::string>& untried() const { return untried_; }
  /// Adds to untried() the labels of sets that would have followed, where the work ends before.
  void leave_untried(const std::vector<std::string>& sets);

 private:
  /// Returns those that are out of the question (highest_of_use).
  std::vector<Fit> add_looks(std::span<const Fit> looks, std::string_view what, double to,
                             std::vector<Explanation>& found);
  /// add_looks(looks), then of others.
  std::vector<Fit> add_in_turn(std::span<const Fit> looks, std::span<const Fit> others,
                               std::string_view what, double to, std::vector<Explanation>& found);
  /// The sum of squares above which a set is out of the question beside the best of as many effects
  /// in `found`: with its parameters it would be worse by four times options.least_information_gain
  /// (information_gain). Infinite where there is none; and for an effect by itself, which is where
  /// larger sets begin, unless one leaves noise.
  double highest_of_use(const Candidate& set, const std::vector<Explanation>& found) const;
  Explanation without_unidentified(Explanation set) const;
  void keep(std::vector<std::optional<Explanation>> made, std::vector<Explanation>& found);

  const Problem& problem_;
  const SelectionOptions& options_;
  ReportedWork& work_;
  CoarseProblems parts_;
  EffectScan scan_;
  std::vector<std::string> untried_;
};

/// "hub_spring + time_delay" for each of `others` that `base` has not.
std::vector<std::string> labels_with(const Candidate& base,
                                     const std::vector<const Hypothesis*>& others);

}  // namespace flexarm::diagnose
