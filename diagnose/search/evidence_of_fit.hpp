#pragma once

#include "diagnose/evidence.hpp"
#include "diagnose/search/scored_fit.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Returns the evidence for each effect of `chosen`, in their order. `without` are the fits of the
/// set without each, all to the estimation runs; `held_out` is the likelihood of the validation
/// runs of their problem. Throws Cancelled where the work is cancelled.
///
/// The estimates of a run are those of one Gauss-Newton step from the values of all runs, by the
/// lines of that run alone and the weights of the likelihood of all runs; their agreement is a
/// chi-squared test over the runs that determine the places of the parameters to less than
/// Policy::place_deviation.
std::vector<EffectEvidence> evidence_for_each(const Likelihood& held_out, const ScoredFit& chosen,
                                              const std::vector<ScoredFit>& without,
                                              const ReportedWork& work);

}  // namespace flexarm::diagnose
