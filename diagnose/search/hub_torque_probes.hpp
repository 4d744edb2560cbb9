#pragma once

#include "diagnose/experiment.hpp"
#include "diagnose/search/hypothesis.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Laws of hub torque of any shape, for what no effect of the library describes: over the hub's
/// angle and over its velocity each a basis of `kHats` hat functions, linear between equidistant
/// places of the range that the sensors of the hub in `time` runs show, and dry friction. Each has
/// one parameter, its torque, up to the root mean square of the recorded torque. Empty without
/// `time` runs that show the hub's motion. Never to be named: directions for a score test.
std::vector<Hypothesis> hub_torque_probes(const Experiment& experiment);
inline constexpr int kHats = 8;

}  // namespace flexarm::diagnose
