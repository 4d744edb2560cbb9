#pragma once

#include "diagnose/search/scored_fit.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace flexarm::diagnose {

/// The bounds of a search, beside the Policy of the problem.
struct SearchBounds {
  std::size_t most_effects = std::numeric_limits<std::size_t>::max();  ///< of a set
  /// Sets that the first rung and the last begin with, beside the arm as filed.
  std::vector<Candidate> starts = {};
};

/// The sets of effects that a search ends with.
struct FoundSets {
  /// The best first; those behind it are the others of the last beam, and rivals: the best with one
  /// effect exchanged for another, one of a family; where the best has no effects, single ones.
  std::vector<ScoredFit> best = {};
  bool is_complete = true;  ///< fitted to all estimation runs
  /// The sample size that the scores are of.
  SampleSize sample_size = SampleSize::of_model_error;
};

/// Searches the set of effects with the lowest score (scored_fit.hpp): on a ladder of ever more
/// data, whose last rung is the runs of `likelihood`,
///
/// - a beam of sets is replaced by the neighbours (moves.hpp) that are predicted to be best and
///   fitted, while the best score falls;
/// - a rung on which the beam does not leave noise is climbed from its sets, if the rung below was
///   climbed, and from the arm as filed: the first such one with all effects, to sets of
///   Policy::depth, and each with the `common` effects alone (effects::Likely), unless one effect
///   by itself left noise; the best of these climbs goes on;
/// - sets with an effect at the end of its range are left;
/// - a rung below all data is climbed to a set that leaves noise (Likelihood::is_noise);
/// - the next rung begins with the effects that are not hopeless on this one, and goes on with all
///   where these do not leave noise;
/// - where the best set leaves noise, exchanges of one effect for another are tried among all
///   effects with the sample size of noise: of sets that all leave noise, that decides.
///
/// After the deadline of the work: the sets by then, which may be of a part of the data. Throws
/// Cancelled where the work is cancelled otherwise.
FoundSets search_sets(const Likelihood& likelihood, const std::vector<Hypothesis>& hypotheses,
                      const SearchBounds& bounds, ReportedWork& work);

}  // namespace flexarm::diagnose
