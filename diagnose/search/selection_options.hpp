#pragma once

#include "diagnose/search/reported_work.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

namespace flexarm::diagnose {

/// How `time` runs are predicted (predictors/predictor.hpp); closed_loop is output error with the
/// controllers of the runs simulated too. frequency_response compares the responses that are
/// estimated of the runs (predictors/response_runs.hpp).
enum class PredictorKind {
  output_error,
  closed_loop,
  grey_box,
  torque_balance,
  driven_by_motion,
  frequency_response
};
inline constexpr std::array kPredictors = {
    PredictorKind::output_error,     PredictorKind::closed_loop,
    PredictorKind::grey_box,         PredictorKind::torque_balance,
    PredictorKind::driven_by_motion, PredictorKind::frequency_response};

/// Runs are simulated in time, without a noise model.
constexpr bool is_simulation(PredictorKind kind) {
  return kind == PredictorKind::output_error || kind == PredictorKind::closed_loop ||
         kind == PredictorKind::driven_by_motion;
}

/// "grey_box".
constexpr std::string_view to_string(PredictorKind kind) {
  switch (kind) {
    case PredictorKind::output_error:
      return "output_error";
    case PredictorKind::closed_loop:
      return "closed_loop";
    case PredictorKind::grey_box:
      return "grey_box";
    case PredictorKind::torque_balance:
      return "torque_balance";
    case PredictorKind::driven_by_motion:
      return "driven_by_motion";
    case PredictorKind::frequency_response:
      return "frequency_response";
  }
  return "";
}

/// How sets of effects are searched for.
enum class SearchMethod {
  staged,  ///< by excess residual over noise, in stages (selection.hpp)
  ranked,  ///< by one score (ranked/ranked_search.hpp); output error and closed loop alone
};

/// How many effects are tried with a base.
struct Tried {
  /// Looked at <= this: those that explain most by a score test.
  std::size_t looks = 0;
  /// Of these refitted to all data <= this, the best.
  std::size_t refitted = 0;
};

/// How sets of effects grow by one effect on a part of the data.
struct SetGrowth {
  /// Sets that effects are added to <= this, the best;
  std::size_t bases = kAll;
  /// effects added to each, special ones and general ones (which have another as a limit), <= this.
  std::size_t special = kAll;
  std::size_t general = kAll;
  /// Of all these sets fitted <= this: those that by the score test leave least.
  std::size_t fitted = kAll;

  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
};

/// Every threshold of the search, each with what it enforces.
struct SelectionOptions {
  SearchMethod method = SearchMethod::staged;
  /// Causes named <= this; any number unless given, by the staged search four: three of the arm,
  /// and one of its recording.
  std::optional<int> most_causes = {};
  /// Chosen by evidence (predictor_choice.hpp) unless given.
  std::optional<PredictorKind> predictor = {};
  /// Another one is taken where what output error leaves is a disturbance of the hub torque >=
  /// this part of the commanded torque's root mean square.
  double least_disturbance = 0.03;

  /// The search ends here with the best so far.
  Deadline deadline = {};
  /// Where not even the arm as filed has been simulated by then, Cancelled is thrown.
  Deadline last = {};

  // An effect is named beside others only where all of these hold (admission.hpp).
  /// Delta BIC (misfit.hpp) without it >= this.
  double least_information_gain = 10.0;
  /// Part of the excess residual of the estimation runs that it explains >= this: a small part of a
  /// residual of another kind is explained by many effects.
  double least_share = 0.5;
  /// The same of the validation runs, which it was not fitted to.
  double least_validated_share = 0.25;
  /// Each parameter is identified by the standard errors that are stated (admission.hpp); these
  /// include the shift of the estimate by so many modes more (parameter_errors.hpp).
  int further_modes = 8;
  /// By output error, what is left of the signal of simulated runs, for estimation as for
  /// validation, <= this: where a simulation runs away from the data, whatever dissipates brings it
  /// nearer.
  double largest_error_left = 0.5;
  /// Where it is above this without causes, and no effect by itself brings it to
  /// largest_error_left, the search by output error ends.
  double runaway_error = 10.0;
  /// Where the best set of two effects leaves on the beginning of the runs more than this, as RMS
  /// value of the residuals in standard deviations of their noise, the search ends.
  double largest_of_pairs = std::numeric_limits<double>::infinity();
  /// Posterior probability of it, or of a set of effects indistinguishable from it, >= this.
  double least_probability = 0.5;

  // Prior of the posterior probability (posterior.hpp).
  /// Of something else than the vocabulary, beside any causes. Each effect of the vocabulary has
  /// one over their number.
  double prior_of_something_else = 0.2;

  // The search ends where the residual is noise (residual_test.hpp), or
  /// where the excess residual relative to the signal of simulated runs <= this.
  double negligible_error = 0.004;

  // Sampling jitter of the torque (torque_timing.hpp) is a nuisance.
  /// It is looked into where the excess residual relative to the signal <= this,
  double largest_timing_error = 0.03;
  /// and corrected where the residual is noise after that, and it explains >= this part of the
  /// excess residual.
  double least_timing_share = 0.5;

  // How far the search goes.
  /// Larger sets, and exchanges of what does not leave noise, are looked for where the last effect
  /// takes this part or more of what the best set without it leaves, of all data or of the coarse
  /// part. In blind trials of two and three effects that were found each took 0.43 or more; of a
  /// simulation beside a random disturbance, a backlash or a stop, which no set explains, 0.12 or
  /// less.
  double least_share_ahead = 0.25;
  /// Effects by themselves: all are scanned.
  Tried single_effects = {.refitted = 8};
  /// A set is near the best where it leaves beyond noise <= this times what that leaves (is_near):
  /// of sets that a coarse look found those are refitted to all data.
  double largest_of_looks = 2.0;
  /// A general effect is refitted to all data where its look leaves <= this times the sum of
  /// squares that the best special effect leaves,
  double largest_of_general = 1.2;
  /// and beyond noise <= this times what a limit of it leaves. Sets with it go on where they do.
  double general_gain = 0.7;
  /// A law of hub torque that is scanned by regression (hub_law_scan.hpp) is fitted where it
  /// explains >= this part of the excess residual of the hub's signals. The true law explains
  /// nearly all of it; one that is named explains least_share of the whole excess residual.
  double least_law_share = 0.1;

  // Sets of several effects (set_search.hpp).
  /// On the early part of the data,
  SetGrowth early_growth = {.bases = 8, .special = 8, .general = 3, .fitted = 32};
  /// of these refitted to the coarse part <= this;
  std::size_t early_sets = 12;
  /// on the coarse part;
  SetGrowth coarse_growth = {.bases = 4, .special = 5, .general = 2, .fitted = 10};
  /// and of all refitted to all data; of these and of any other sets, where the best does not leave
  /// noise on the coarse part, far_sets_refitted or less.
  std::size_t sets_refitted = 6;
  std::size_t far_sets_refitted = 2;
  /// Effects beside those that are chosen, or in place of one of them,
  Tried effects_beside = {.looks = 10, .refitted = 5};
  /// and general ones in place of one of several causes.
  Tried general_effects = {.looks = 5, .refitted = 2};
  /// Samples of each run in the coarse look <= this,
  std::size_t coarse_samples = 1200;
  /// and in closed loop, where what a controller makes of the samples left out is not known.
  std::size_t coarse_loop_samples = 6000;
  /// and where what all data leave shows late in the runs (CoarseProblems::lengthen).
  std::size_t most_coarse_samples = 10000;
  /// The same in a second look at effects of several parameters: where the hub turns another way
  /// from the start, nothing after it tells which value is nearer.
  std::size_t short_samples = 400;
  /// Samples of each run that a filter follows <= this: it is decimated for that.
  std::size_t filtered_samples = 4000;
  /// Flexible modes in the coarse look <= this.
  int coarse_modes = 6;
  /// Values tried in a scan of an effect of 1, 2, 3 parameters or more.
  std::array<int, 3> scan_evaluations = {40, 90, 160};
  /// The same for a law of hub torque that is scanned by regression, not simulated, with so many
  /// parameters beside its amplitude and phase.
  std::array<int, 3> law_evaluations = {300, 300, 1500};
  /// Of these begun a fit from <= this, for an effect of several parameters.
  int scan_starts = 3;
  /// Causes exchanged for others, one after the other, <= this.
  int most_exchanges = 4;
};

}  // namespace flexarm::diagnose
