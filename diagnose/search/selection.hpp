#pragma once

#include "diagnose/evidence.hpp"
#include "diagnose/search/explanation.hpp"
#include "diagnose/search/posterior.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/run_drift.hpp"
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

/// An effect that was not fitted to all data, as a look at a part of them ruled it out; or not to
/// the end, as it is decisively worse than another one that leaves noise.
struct RuledOut {
  std::string effect;  ///< its label
  /// Of the excess residual of that part that it explains there at its best values, 0 to 1; a law
  /// of hub torque that is scanned by regression, of that of the hub's signals.
  double share = 0.0;
};

/// How the causes were found.
struct Selection {
  /// The problem as it was solved: with the noise that the residuals of the best single show
  /// (Problem::lower_noise), and the torques as their timing corrects them.
  Problem problem;
  std::size_t hypotheses = 0;             ///< how many were searched among
  Explanation nothing = {};               ///< no cause; the arm's uncertain numbers refitted
  std::vector<Explanation> singles = {};  ///< hypotheses by themselves, the best first
  std::vector<Explanation> combinations =
      {};                                ///< of two effects or more, those tried; the best first
  Explanation chosen = {};               ///< `nothing`, or with the causes
  std::vector<RuledOut> ruled_out = {};  ///< by themselves, those that explain most first
  /// The chosen one with a cause exchanged for one that is indistinguishable from it (rivals.hpp).
  std::vector<Explanation> rivals = {};
  /// Of effects that the chosen one would have but for it (inconsistent_estimates).
  std::vector<RunDrift> inconsistent = {};
  std::optional<TorqueTiming> timing = {};  ///< by which torques were corrected
  /// That explains a good part of the excess residual, but does not leave noise: undecided.
  std::optional<TorqueTiming> undecided_timing = {};
  /// The evidence for each effect of the chosen set, and the set without it; empty by the staged
  /// search.
  std::vector<EffectEvidence> evidence = {};
  std::vector<Explanation> without = {};
  std::optional<SearchEnd> end = {};  ///< of a search that is incomplete
  bool cancelled = false;

  /// Those with as many effects as `set`: `singles` or `combinations`.
  std::vector<Explanation>& sets_like(const Candidate& set) {
    return set.effects.size() == 1 ? singles : combinations;
  }
};

/// Looks for the causes of what `problem` shows beyond noise: each hypothesis by itself, scanned
/// over its whole range and refitted; sets of two and more (set_search.hpp); each of several
/// exchanged for another while that fits better, and left out.
/// After the deadline: the best so far, of what was fitted to all data; where that is nothing, the
/// arm as filed. Throws Cancelled after options.last.
/// The problem that comes back has the noise level that the best single leaves to be seen, and
/// torques corrected where their timing explains what is left.
Selection staged_selection(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                           const SelectionOptions& options, const DiagnosisProgress& progress);

/// Selects effects by options.method: staged_selection, or ranked_selection.
Selection select(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, const DiagnosisProgress& progress = {});

}  // namespace flexarm::diagnose
