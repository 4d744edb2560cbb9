#pragma once

#include "diagnose/search/fit.hpp"
#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::diagnose {

/// A torque that takes effect later (or earlier) than its samples say, by a fraction of a sampling
/// period that changes along a run: clocks that drift, a converter that now and then misses its
/// tick. No cause of the vocabulary, and found in a fit as a small misfit that any effect reduces a
/// little.
struct TorqueTiming {
  /// Of each run by stretches of equal length, in sampling periods; empty but for `time` runs.
  std::vector<Eigen::VectorXd> late;
  double share = 0.0;  ///< of what is beyond noise in the estimation runs that it accounts for
};

/// The timing that explains most of what a fit leaves, its parameters moving along, by linear least
/// squares with a normal prior of deviation `kTimingKnown` on each stretch. Lateness is beside that
/// of most stretches (their median by weight): one delay for all is a cause of the vocabulary.
TorqueTiming torque_timing(const Problem& problem, const Fit& fit);
inline constexpr int kTimedStretches = 40;
inline constexpr double kTimingKnown = 0.1;  ///< of a sampling period

/// The experiment with the torque that acted: over one sample a torque that changes late by d of it
/// has the mean torque_k + d (torque_(k-1) - torque_k).
Experiment retimed(Experiment experiment, const TorqueTiming& timing);

}  // namespace flexarm::diagnose
