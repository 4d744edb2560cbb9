#pragma once

#include "diagnose/ranked/ranked_fit.hpp"

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// An effect beside a fitted candidate, as the score test predicts it.
struct RankedAddition {
  const Hypothesis* effect = nullptr;
  std::vector<double> values = {};  ///< to begin a fit with
  double score = 0.0;               ///< predicted RankedFit::score of the fit with it
};

/// Returns the `most` of `others` with the lowest predicted score beside `base`, the best first.
/// The Lagrange multiplier test [Rao1948, Silvey1959] on weighted lines y: with c the change that a
/// few values of an effect make of them, a its size, and P = I - J J^+ what refitting the base
/// leaves, the lines with the effect are P(y + a c). The size is that of the least squares of
/// these; its score is that of the likelihood of their squares, in which the noise is estimated
/// again. Effects that the base has, and those that no value makes an arm of, are left out. Throws
/// Cancelled where the work is cancelled.
std::vector<RankedAddition> ranked_additions(const Likelihood& likelihood, const RankedFit& base,
                                             const std::vector<const Hypothesis*>& others,
                                             std::size_t most, const ReportedWork& work);

}  // namespace flexarm::diagnose
