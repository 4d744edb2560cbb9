#pragma once

#include "diagnose/search/scan.hpp"

#include <optional>
#include <vector>

namespace flexarm::diagnose {

struct HubLawScan {
  std::vector<Candidate> starts;  ///< the best first
  /// Part of what is beyond noise in the hub's signals that the best of them takes away.
  double share = 0.0;
};

/// A scan of a law of hub torque, the last effect of `start`, without simulating it: its torque is
/// that at the measured motion, and what this makes of the hub's signals is linear
/// (symptoms/hub_regression.hpp). A simulation has to iterate the torque within each step, or
/// follow how friction changes in it, at some ten times the cost of another one.
///
/// Empty for an effect that is more than such a law; for a constant torque, and for dry friction
/// that is the same at every speed; for a law with states of its own. Empty where a run is not a
/// `time` run by output error that shows the hub. Of friction, empty where the hub rests in more
/// than `kMostRest` of the samples: what it is then is not known by the velocity. Throws Cancelled
/// where the work is cancelled.
std::optional<HubLawScan> scan_hub_law(const Problem& problem, const Candidate& start,
                                       const ScanOptions& options);
inline constexpr double kMostRest = 0.1;

}  // namespace flexarm::diagnose
