#pragma once

#include "diagnose/evidence.hpp"
#include "diagnose/search/explanation.hpp"
#include "diagnose/search/posterior.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"
#include "diagnose/search/torque_timing.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// Where SelectionOptions::deadline ended a search.
struct SearchEnd {
  std::string stage;  ///< "effects one by one"
  /// Sets of effects that were about to be tried at that stage, and were not fitted.
  std::vector<std::string> untried;
};

/// How the causes were found.
struct Selection {
  /// The problem as it was solved: with the noise that the residuals of the best set show
  /// (Problem::lower_noise), and the torques as their timing corrects them.
  Problem problem;
  std::size_t hypotheses = 0;             ///< how many were searched among
  Explanation nothing = {};               ///< no cause; the arm's uncertain numbers refitted
  std::vector<Explanation> singles = {};  ///< hypotheses by themselves, the best first
  std::vector<Explanation> combinations =
      {};                   ///< of two effects or more, those tried; the best first
  Explanation chosen = {};  ///< `nothing`, or with the causes
  /// The chosen one with a cause exchanged for one that is indistinguishable from it (rivals.hpp).
  std::vector<Explanation> rivals = {};
  std::optional<TorqueTiming> timing = {};  ///< by which torques were corrected
  /// That explains a good part of the excess residual, but does not leave noise: undecided.
  std::optional<TorqueTiming> undecided_timing = {};
  /// The evidence for each effect of the chosen set, and the set without it; empty where the time
  /// limit left no time for it.
  std::vector<EffectEvidence> evidence = {};
  std::vector<Explanation> without = {};
  std::optional<SearchEnd> end = {};  ///< of a search that is incomplete
  bool cancelled = false;

  /// Those with as many effects as `set`: `singles` or `combinations`.
  std::vector<Explanation>& sets_like(const Candidate& set) {
    return set.effects.size() == 1 ? singles : combinations;
  }
};

/// Selects the set of effects that explains what `problem` shows: that of the lowest score
/// (set_search.hpp), without the effects that validation runs are predicted better without, with
/// the noise and the timing of the torque that the data show beside it (nuisances.hpp).
/// After the deadline: the best so far; where that is nothing, the arm as filed. Throws Cancelled
/// after options.last.
Selection select(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options = {}, const DiagnosisProgress& progress = {});

}  // namespace flexarm::diagnose
