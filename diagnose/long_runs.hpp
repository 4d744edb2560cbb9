#pragma once

#include "measured/run_identification.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// How much of a long `time` run is used. The time of a search grows with the samples, while the
/// standard errors of a fit fall as their square root.
struct LongRunOptions {
  /// A run of more samples than this is cut. All stretches together have fewer: a run that is cut
  /// costs no more than the longest that is used whole.
  std::size_t longest_run = 25'000;
  /// Samples of a stretch: some hundred for each number of an unknown initial state, and four
  /// seconds at 1 kHz, which are many periods of any mode that is sampled well.
  std::size_t stretch = 4096;
  /// Stretches that all long runs together have <= this, but each run has one.
  std::size_t estimation_stretches = 4;
  std::size_t validation_stretches = 2;
  /// Root mean square of a stretch's torque >= this part of that of the run's strongest stretch.
  double least_excitation = 0.1;
};

/// Puts stretches in the place of each `time` run that is too long, in the order of time.
///
/// - Each stretch has an initial state of its own, which is free; that which begins a run from rest
///   begins at rest, where its torque does.
/// - Only stretches that excite the arm and show a motion in every channel are taken. For
///   estimation: that which begins at rest, the most exciting one, then by turns the one whose
///   condition is farthest from those taken. The condition is the logarithms of the torque's root
///   mean square, of how fast it changes and of its crest, and of each channel's deviation. For
///   validation: the most exciting one and the farthest from it.
/// - Of a run without a purpose which is the only run, the last third of the time is for
///   validation, and at least one stretch before it is unused. Every other run has a purpose, which
///   is that of its stretches.
/// - A closed loop whose controller has an internal state is not in a known state in the midst of a
///   run: only its beginning is used, `longest_run` samples of it.
///
/// A run none of whose stretches can be taken stays as it is. Returns a sentence for each run that
/// was cut.
std::vector<std::string> cut_long_runs(std::vector<measured::MeasuredRun>& runs,
                                       const LongRunOptions& options = {});

}  // namespace flexarm::diagnose
