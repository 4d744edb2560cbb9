#pragma once

#include "diagnose/search/coarse_problems.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/hub_law_scan.hpp"
#include "diagnose/search/linear_refit.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// Of the excess residual that one fit leaves, the part that another one to the same data does not,
/// 0 to 1.
double explained_share(const Fit& before, const Fit& after);

/// The first look at effects: scans over their whole ranges on a part of the data with few modes.
/// Throws Cancelled where the work is cancelled.
class EffectScan {
 public:
  /// The references must outlive the object.
  EffectScan(const CoarseProblems& parts, const SelectionOptions& options, ReportedWork& work)
      : parts_(parts), options_(options), work_(work) {}

  /// Part of the sum of squares that `base` leaves which the score test says that a hypothesis
  /// explains (additions.hpp).
  double share_of(const Candidate& base, const Hypothesis& other) const;
  /// The `most` hypotheses that explain most of what `base` leaves (additions.hpp).
  std::vector<const Hypothesis*> promising(const Candidate& base,
                                           std::vector<const Hypothesis*> others, std::size_t most,
                                           std::string_view what);

  /// `base` with each of the hypotheses as a scan of it found it, the best first.
  std::vector<Fit> first_looks(const Candidate& base, const std::vector<const Hypothesis*>& others,
                               std::string_view what, double from, double to);

  /// `base` refitted to the part of the data, its uncertain numbers from a scan of them too.
  Fit first_look(const Candidate& base) const;
  /// `base` with `other`: a scan of that, then all refitted to the part of the data. An effect of
  /// several parameters that explains options.least_share of the early part is scanned on that
  /// alone. A law of hub torque that is scanned by regression and explains less than
  /// options.least_law_share stays as the scan left it.
  Fit first_look(const Candidate& base, const Hypothesis& other) const;
  /// `base` with `other` on the early part alone, and a candidate refitted to that.
  Fit early_look(const Candidate& base, const Hypothesis& other) const;
  Fit early_look(const Candidate& candidate) const;
  /// A candidate refitted to the coarse part.
  Fit coarse_look(const Candidate& candidate) const;
  /// The same for `other` in place of the `index`-th effect of `candidate`. Where that is a limit
  /// of it, looked for from there too: at the limit's values of the parameters that both have.
  Fit look_in_place(const Candidate& candidate, std::size_t index, const Hypothesis& other) const;
  /// Of these the second look alone: with `general` in place of the `index`-th effect of
  /// `limited`, a limit of it, and the limit's values of the parameters that both have; the others
  /// are scanned. Where they have none in common, look_in_place.
  Fit look_from_limit(const Candidate& limited, std::size_t index, const Hypothesis& general) const;
  /// HubLawScan::share of a law of hub torque, without a fit: the larger one of those in the longer
  /// and in the shorter part of the data. In the longer one the minima of a frequency are narrower,
  /// and the scan may miss them. Empty for effects that are not scanned in this way.
  std::optional<double> share_of_law(const Candidate& base, const Hypothesis& other) const;

 private:
  std::optional<HubLawScan> hub_law_scan(const Problem& problem, const Candidate& start) const;
  /// From the places of the law's scan; without a law, of a scan of the last effect of `start`.
  Fit best_look(const Problem& part, const Candidate& start,
                const std::optional<HubLawScan>& law) const;
  Fit best_fit(const Problem& problem, const std::vector<Candidate>& starts) const;
  /// Of an effect of three parameters or more at a place along the beam, the place and the size are
  /// scanned once more beside what was found of the others: each place may have a minimum.
  Fit best_from_scan(const Problem& problem, const Candidate& start,
                     const std::vector<Eigen::Index>& scanned) const;
  /// `start` with the value of one coordinate, of those over its range, that leaves least.
  Candidate least_in_range(const LinearRefit& refit, const Candidate& start,
                           Eigen::Index scanned) const;
  /// Empty where they have no parameter in common.
  std::optional<Fit> look_with_limits_values(const Candidate& limited, std::size_t index,
                                             const Hypothesis& general) const;

  const CoarseProblems& parts_;
  const SelectionOptions& options_;
  ReportedWork& work_;
};

}  // namespace flexarm::diagnose
