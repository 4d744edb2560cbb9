#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/selection_options.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// An effect of the candidate, by its index, with a parameter that the data do not identify. A
/// parameter is identified if it ends inside the range that it was looked for in, or may be inside
/// by its standard error; and if its standard error is smaller than the distance from the value at
/// which the effect does nothing; where there is none, than the value itself or, on a linear range,
/// than half the range. `errors` are those of Candidate::coordinates (parameter_errors.hpp); where
/// there are none, as of a fit that failed, the first effect is unidentified.
std::optional<std::size_t> unidentified_effect(const Candidate& candidate,
                                               const Eigen::VectorXd& errors);

/// The same by the standard errors of least squares, widened by the residuals where these are above
/// the noise.
std::optional<std::size_t> unidentified_effect(const Explanation& explanation);
/// No effect of it is unidentified by those.
bool is_identified(const Explanation& explanation);

/// Whether the effects that `fuller` has beyond `simpler` may be named: they are identified and
/// clear the bars of `options`. Validation runs that are noise without the effects must be noise
/// with them. Where `simpler` leaves noise within the tolerance of its level, and an error above
/// options.negligible_error that `fuller` does not leave, that error counts as excess residual.
bool clears_bars(const Explanation& fuller, const Explanation& simpler,
                 const SelectionOptions& options);

/// On a part of the data, a fit of a set with a general effect leaves clearly less beyond noise
/// than one with a limit of that effect: options.general_gain.
bool is_ahead_of_limit(const Fit& general, const Fit& limited, const SelectionOptions& options);

/// Of two fits to the same data: the sum of squares that a set leaves is near the one that the best
/// set leaves. Near is what is beyond noise by options.largest_of_looks times as much as of the
/// best, and by a tenth of the noise, which a fit of few steps with few modes may be off by.
bool is_near(const Fit& set, const Fit& best, const SelectionOptions& options);
/// A fit leaves what is near to noise in that way.
bool is_near_noise(const Fit& look);

/// Of the sets of so many effects in `found`, which are sorted by fit, the best, or one with fewer
/// parameters that it does not clear the bars over; null where there are none.
const Explanation* simplest(const std::vector<Explanation>& found, std::size_t effects,
                            const SelectionOptions& options);

/// What a simulation leaves of `time` runs is near their signal's own size (options.
/// largest_error_left): it has run away from the data, and no effect may be named. With a
/// disturbance: what it leaves to that is near the size of the commanded torque.
bool runs_away(const Explanation& explanation, const SelectionOptions& options);

/// Without causes a simulation is off by more than options.runaway_error, and no effect by itself
/// keeps it from running away: several of them are not searched for.
bool is_out_of_reach(const Explanation& nothing, const std::vector<Explanation>& singles,
                     const SelectionOptions& options);

/// Laws of hub torque add up in the torque that is missing from a balance: of several that explain
/// it one explains options.least_share_ahead by itself. Else sets may explain what no single does.
bool may_sets_explain(const Explanation& nothing, const std::vector<Explanation>& singles,
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
