#pragma once

#include "diagnose/planning/planned_experiment.hpp"
#include "diagnose/search/candidate.hpp"

#include <optional>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// One direction in which an effect grows from where it does nothing: all parameters that have such
/// a place move from it together, those that grow from 0 in one ratio, the others stand still.
struct Growth {
  Hypothesis hypothesis;
  bool downward = false;             ///< towards the lowest place instead of the highest
  std::vector<double> other_places;  ///< of the parameters without a neutral place, in their order

  /// The effect's values at a strength from 0, nothing, to 1, the end of its range.
  Candidate at(double strength) const;
};

/// The directions of an effect, the others' places in the middle: two where its neutral place is
/// inside its range, none where it has none.
std::vector<Growth> growths_of(const Hypothesis& hypothesis);

/// What a planned experiment shows of an effect by itself.
struct Detection {
  Hypothesis hypothesis;
  bool shows = false;  ///< somewhere in its range
  /// The smallest values that would be found; empty for an effect that is there or not, without a
  /// size, and for one that does not show.
  std::optional<Candidate> smallest;
  /// Where it is held against the others: `kCompared` times the smallest change that would be
  /// found, or at the end of its range.
  std::optional<Candidate> compared;
  double compared_change = 0.0;  ///< of the data, in standard deviations
  double largest_change = 0.0;   ///< at the end of its range
};
/// At the limit of detection the expected lead over any rival is small: what cannot be told there
/// is said of nearly all.
inline constexpr double kCompared = 3.0;

/// The smallest change of the data, in standard deviations, that diagnose would name an effect of
/// so many parameters for: ahead by `least_gain` in information, and beyond what chance and a noise
/// known to `kNoiseKnown` of its power would make (Misfit::excess).
double detectable_change(const Problem& problem, std::size_t parameters, double least_gain);

/// By a bracketed search [AlefeldPotraShi1995] of each direction, to 1 % of the strength.
Detection detect(const PlannedExperiment& planned, const Hypothesis& hypothesis, double least_gain);

}  // namespace flexarm::diagnose
