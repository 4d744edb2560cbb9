#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/torque_timing.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// Every threshold of the search, each with what it enforces.
struct SelectionOptions {
  /// Causes named <= this.
  int most_causes = 3;

  // An effect is named beside others only where all of these hold.
  /// Delta BIC (misfit.hpp) without it >= this.
  double least_information_gain = 10.0;
  /// Excess residual of the estimation runs that it explains >= this part of what is there without
  /// it: a small part of a residual of another kind is explained by many effects.
  double least_share = 0.5;
  /// The same of the validation runs, which it was not fitted to.
  double least_validated_share = 0.25;

  // The search ends where the excess residual is explained.
  /// Excess residual relative to the signal of simulated runs <= this (the step of another
  /// simulation),
  double negligible_error = 0.004;
  /// or <= this part of what it was without any cause (of the signal, where that was more). An
  /// uncertain number of the arm far from its file's is neither.
  double negligible_share = 0.03;

  // Sampling jitter of the torque (torque_timing.hpp) is a nuisance.
  /// It is looked into where the excess residual relative to the signal <= this,
  double largest_timing_error = 0.03;
  /// and corrected where it explains >= this part of that before further effects are tried (it
  /// goes along with a small effect of any kind for a good part),
  double sure_timing_share = 0.9;
  /// or >= this part once no further effect was found.
  double least_timing_share = 0.5;

  // How far the search goes.
  /// Singles refitted to all data <= this, the best of the coarse look.
  std::size_t singles_refitted = 8;
  /// Singles that are bases of pairs <= this.
  std::size_t pair_bases = 3;
  /// Effects scanned beside a base <= this: those whose directions the residuals have most of.
  std::size_t scanned_beside = 10;
  /// Of these refitted to all data <= this.
  std::size_t pairs_refitted = 5;
  /// Samples of each run in the coarse look <= this.
  std::size_t coarse_samples = 1200;
  /// The same in a second look at effects of several parameters: where the hub turns another way
  /// from the start, nothing after it tells which value is nearer.
  std::size_t short_samples = 400;
  /// Flexible modes in the coarse look <= this.
  int coarse_modes = 8;
  /// Values tried in a scan of an effect of 1, 2, 3 parameters or more.
  std::array<int, 3> scan_evaluations = {40, 90, 160};
  /// Causes exchanged for others, one after the other, <= this.
  int most_exchanges = 4;
  /// Rounds that each add a cause, or exchange some for others, <= this.
  int most_rounds = 4;
};

/// How the causes were found.
struct Selection {
  /// The problem as it was solved: with the noise that the residuals of the best single show
  /// (Problem::lower_noise), and the torques as their timing corrects them.
  Problem problem;
  Explanation nothing = {};               ///< no cause; the arm's uncertain numbers refitted
  std::vector<Explanation> singles = {};  ///< hypotheses by themselves, the best first
  std::vector<Explanation> combinations =
      {};                                ///< of two effects or more, those tried; the best first
  Explanation chosen = {};               ///< `nothing`, or with the causes
  std::vector<Explanation> rivals = {};  ///< the chosen one with a cause exchanged, the best first
  std::optional<TorqueTiming> timing = {};  ///< by which torques were corrected
  bool cancelled = false;
};

/// Whether `left` is noise, or as little more as the options neglect; `nothing` is without causes.
bool is_explained(const Misfit& left, const Misfit& nothing, const SelectionOptions& options);

/// Looks for the causes of what `problem` shows beyond noise: each hypothesis by itself, scanned
/// over its whole range and refitted; pairs of the best with any other; further ones while each
/// takes its share; each of several exchanged for another while that fits better, and left out.
/// The problem that comes back has the noise level that the best single leaves to be seen, and
/// torques corrected where their timing explains what is left.
Selection select(Problem problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, const DiagnosisProgress& progress = {});

}  // namespace flexarm::diagnose
