#include "diagnose/search/bases.hpp"

#include <algorithm>
#include <cstddef>

namespace flexarm::diagnose {

std::vector<Candidate> pair_bases(const std::vector<Explanation>& singles,
                                  const GeneralEffects& general, const SelectionOptions& options) {
  std::vector<Hypothesis> special;
  for (const Explanation& single : singles) {
    const Hypothesis& effect = single.fit.candidate.effects.front();
    if (special.size() < options.pair_bases && !general.has(effect)) special.push_back(effect);
  }
  std::vector<Candidate> bases;
  for (const Explanation& single : singles) {
    const Hypothesis& effect = single.fit.candidate.effects.front();
    if (bases.size() < options.pair_bases && limits_of(effect, special).empty()) {
      bases.push_back(single.fit.candidate);
    }
  }
  return bases;
}

std::vector<Candidate> triple_bases(const std::vector<Explanation>& combinations,
                                    const GeneralEffects& general,
                                    const SelectionOptions& options) {
  std::vector<Candidate> bases;
  for (const Explanation& set : combinations) {
    const Candidate& candidate = set.fit.candidate;
    const bool is_special = std::ranges::none_of(
        candidate.effects, [&](const Hypothesis& effect) { return general.has(effect); });
    if (bases.size() < options.triple_bases && candidate.effects.size() == 2 && is_special) {
      bases.push_back(candidate);
    }
  }
  return bases;
}

}  // namespace flexarm::diagnose
