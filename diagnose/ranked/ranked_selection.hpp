#pragma once

#include "diagnose/search/predicted_selection.hpp"

namespace flexarm::diagnose {

/// Selects effects by the ranked search (ranked_search.hpp), with simulations of `problem`. An
/// effect is left out where the extended arm predicts the validation runs better without it, the
/// others refitted. `singles` and `combinations` are the sets of the last beam, each chosen effect
/// by itself, and the chosen set without each.
PredictedSelection select_by_rank(const SelectionTask& task, const Problem& problem,
                                  const DiagnosisProgress& progress);

}  // namespace flexarm::diagnose
