#pragma once

#include "diagnose/search/scan.hpp"

#include <optional>
#include <vector>

namespace flexarm::diagnose {

struct FrictionScan {
  std::vector<Candidate> starts;  ///< the best first
  /// Part of what is beyond noise in the hub's signals that the best of them takes away.
  double share = 0.0;
};

/// A scan of dry friction that changes with speed, the last effect of `start`, without simulating
/// it: its torque is that at the measured velocity, and what this makes of the hub's signals is
/// linear (symptoms/hub_regression.hpp). A simulation has to follow how the friction changes within
/// a step, at some ten times the cost of another one.
///
/// Empty for another effect, where a run is not a `time` run by output error that shows the hub,
/// and where the hub rests in more than `kMostRest` of the samples: what friction is then is not
/// known by the velocity. Throws Cancelled where the work is cancelled.
std::optional<FrictionScan> scan_friction(const Problem& problem, const Candidate& start,
                                          const ScanOptions& options);
inline constexpr double kMostRest = 0.1;

}  // namespace flexarm::diagnose
