#pragma once

#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"
#include "diagnose/search/torque_timing.hpp"

#include <optional>

namespace flexarm::diagnose {

// Nuisances are what a recording adds to residuals, and no effects. Each function takes one from
// the residuals of a set of effects, and returns a problem with it.

/// A problem with corrected torques.
struct TimedProblem {
  Problem problem;
  TorqueTiming timing;
};

/// Returns `problem` with the torques as their timing (torque_timing.hpp) corrects them beside
/// `set`, where the residuals are no noise, small (SelectionOptions::largest_timing_error), and the
/// timing explains a good part of their excess (least_timing_share); empty elsewhere, and where the
/// recorded torque does not drive the arm.
std::optional<TimedProblem> with_timing(const Problem& problem, const Candidate& set,
                                        const SelectionOptions& options);

/// Returns `problem` with the coloured noise that `set` leaves, where its residuals are no white
/// noise, are noise of that colour, and do not depend at `level` on what the arm does
/// (dependence.hpp); empty elsewhere. Throws Cancelled where the work is cancelled.
std::optional<Problem> with_noise_colour(const Problem& problem, const Candidate& set, double level,
                                         ReportedWork& work);

}  // namespace flexarm::diagnose
