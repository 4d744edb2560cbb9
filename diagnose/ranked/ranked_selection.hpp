#pragma once

#include "diagnose/search/selection.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Selects effects by the ranked search (ranked_search.hpp), with the residuals of `problem`.
/// Nothing is searched for where the arm as filed leaves noise. The problem that comes back has the
/// noise that the residuals show, and the torques as their timing corrects them (nuisances.hpp). An
/// effect is left out where the extended arm predicts the validation runs better without it, the
/// others refitted. `singles` and `combinations` are the sets of the last beam, each chosen effect
/// by itself, and the chosen set without each.
Selection ranked_selection(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                           const SelectionOptions& options, const DiagnosisProgress& progress);

}  // namespace flexarm::diagnose
