#pragma once

#include "diagnose/search/scored_fit.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// A change of a set by one move: an effect added, one dropped, or both, which is a swap.
struct Move {
  std::optional<std::size_t> dropped = {};  ///< index of the effects of the set
  const Hypothesis* added = nullptr;
  std::vector<double> values = {};  ///< of the added effect, to begin a fit with
  /// The predicted step of the coordinates of the effects that stay; empty but for a swap.
  Eigen::VectorXd step = {};
  double score = 0.0;  ///< predicted ScoredFit::score of the fit

  /// Returns the set after the move; the effects that stay have their values, or with `is_refitted`
  /// those that are predicted.
  Candidate of(const Candidate& set, bool is_refitted = false) const;
};

/// Returns all moves of `base`, those with the lowest predicted score first: of each effect of
/// `others` the best of a few values (start_places.hpp), and of one with several parameters the
/// best ones of a few shapes. Effects that change nothing, or with which there is no arm, are left
/// out.
///
/// The prediction is the Lagrange multiplier test [Rao1948, Silvey1959] on weighted lines. With y
/// the lines of the set, or of the set without the dropped effect, c the change that the added one
/// makes of them, a its size and P = I - J J^+ what refitting the others leaves, the lines after
/// the move are P(y + a c), the size that of their least squares. The score is that of the
/// likelihood of these lines, in which the noise is estimated again. c is taken beside the whole
/// set, so that it serves all swaps but those of effects that depend on each other: of one family,
/// which act at one place, and of an effect and a limit of it. There a swap also begins at the
/// values of the parameters that both have. An effect with a frequency is looked at where what the
/// set leaves has peaks; one of the set gives place to itself there. Throws Cancelled where the
/// work is cancelled.
std::vector<Move> moves_of(const Likelihood& likelihood, const ScoredFit& base,
                           std::span<const Hypothesis> others, const ReportedWork& work);

}  // namespace flexarm::diagnose
