#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/general_effects.hpp"
#include "diagnose/search/selection_options.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Of effects by themselves, the best first: those that are combined with any other. A general
/// effect is left out beside a limit of it.
std::vector<Candidate> pair_bases(const std::vector<Explanation>& singles,
                                  const GeneralEffects& general, const SelectionOptions& options);

/// Of combinations, the best first: the pairs of special effects that are combined with a third.
std::vector<Candidate> triple_bases(const std::vector<Explanation>& combinations,
                                    const GeneralEffects& general, const SelectionOptions& options);

}  // namespace flexarm::diagnose
