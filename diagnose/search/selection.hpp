#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/torque_timing.hpp"

#include <optional>
#include <vector>

namespace flexarm::diagnose {

struct SelectionOptions {
  int most_causes = 3;
  /// An effect is named only where it takes away this part, or more, of what is beyond noise
  /// without it: a small part of a misfit that is of another kind is taken by many effects.
  double least_share = 0.5;
  /// ... on validation runs, which it was not fitted to, this part.
  double least_validated_share = 0.25;
  double least_information_gain = 10.0;
  /// What is beyond noise is explained well enough where it is at most this, relative to the signal
  /// of simulated runs (the step of another simulation), or this part of what was there without any
  /// cause (of the signal, where that was more); an uncertain number of the arm far from its file's
  /// is neither.
  double negligible_error = 0.004;
  double negligible_share = 0.03;
  /// The timing of the torque (torque_timing.hpp) is looked into where this is left, and believed
  /// where it accounts for this part of it: the greater before further effects are tried, for it
  /// goes along with a small effect of any kind for a good part.
  double largest_timing_error = 0.03;
  double sure_timing_share = 0.9;
  double least_timing_share = 0.5;
};

/// How the causes were found.
struct Selection {
  Explanation nothing;                    ///< no cause; the arm's uncertain numbers refitted
  std::vector<Explanation> singles;       ///< hypotheses by themselves, the best first
  std::vector<Explanation> combinations;  ///< of two effects or more, those tried; the best first
  Explanation chosen;                     ///< `nothing`, or with the causes
  std::vector<Explanation> rivals;        ///< the chosen one with a cause exchanged, the best first
  std::optional<TorqueTiming> timing;     ///< by which torques were corrected
  bool cancelled = false;
};

/// Whether `left` is noise, or as little more as the options neglect; `nothing` is without causes.
bool is_explained(const Misfit& left, const Misfit& nothing, const SelectionOptions& options);

/// Looks for the causes of what `problem` shows beyond noise: each hypothesis by itself, scanned
/// over its whole range and refitted; pairs of the best with any other; further ones while each
/// takes its share; each of several exchanged for another while that fits better, and left out.
/// Lowers the problem's noise to what the best by itself leaves to be seen (Problem::lower_noise),
/// and corrects its torques where their timing explains what is left.
Selection select(Problem& problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, const DiagnosisProgress& progress = {});

}  // namespace flexarm::diagnose
