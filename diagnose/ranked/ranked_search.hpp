#pragma once

#include "diagnose/ranked/ranked_fit.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// How far the ranked search goes.
struct RankedOptions {
  std::size_t beam = 3;   ///< sets that grow at a time on the first rung; on others one does
  std::size_t looks = 6;  ///< moves of each that are fitted, the best by prediction
  /// Each rung is climbed with this part of the effects of the one below, the best by prediction.
  std::size_t halving = 2;
  /// Flexible modes on the rungs below all data <= this.
  int coarse_modes = 6;
  /// Samples of each run on the rungs below all data.
  std::array<std::size_t, 3> rungs = {400, 1600, 6400};
};

/// The sets of effects that a search ends with, the best first.
struct RankedSets {
  std::vector<RankedFit> best = {};
  bool is_complete = true;  ///< fitted to all estimation runs
};

/// Searches the set of effects with the lowest score (ranked_fit.hpp): on a ladder of ever more
/// data, whose last rung is all estimation runs,
///
/// - a beam of sets grows by one effect at a time, those that the score test ranks first, while the
///   best score falls;
/// - the best set is improved by dropping an effect, and by swapping one for another, while that
///   lowers the score;
/// - an effect that is not material (RankedOptions::least_drop) is dropped, and one that is not
///   material beside its limit yields to it.
///
/// After the deadline of the work: the sets by then, which may be of a part of the data. Throws
/// Cancelled where the work is cancelled otherwise.
RankedSets ranked_search(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                         const RankedOptions& options, ReportedWork& work);

}  // namespace flexarm::diagnose
