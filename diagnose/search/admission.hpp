#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/selection_options.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Whether the data identify every parameter of the candidate's effects. Each ends inside the range
/// that it was looked for in, or may be inside by its standard error. The standard error (least
/// squares, widened by the residuals where these are above the noise) is smaller than the distance
/// from the value at which the effect does nothing; where there is none, than the value itself or,
/// on a linear range, than half the range.
bool is_identified(const Explanation& explanation);

/// Whether the effects that `fuller` has beyond `simpler` may be named: they are identified and
/// clear the bars of `options`. Validation runs that are noise without the effects must be noise
/// with them.
bool clears_bars(const Explanation& fuller, const Explanation& simpler,
                 const SelectionOptions& options);

/// An effect of a candidate that has an effect of `hypotheses` as a limit, and that limit.
struct LimitOfEffect {
  std::size_t effect = 0;  ///< index of Candidate::effects
  const Hypothesis* limit = nullptr;
};
/// All of them; limits that the candidate has beside the effect are left out.
std::vector<LimitOfEffect> limits_in(const Candidate& candidate,
                                     const std::vector<Hypothesis>& hypotheses);

}  // namespace flexarm::diagnose
