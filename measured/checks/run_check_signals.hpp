#pragma once

#include "measured/checks/data_check_transform.hpp"
#include "measured/checks/run_check.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// The begin of a run, as checks between runs see it: of a long run the first samples say enough.
struct RunSignals {
  std::vector<CheckedSignal> signals;  ///< torque first; they point into the run's record
  std::vector<bool> usable;            ///< that vary and have no finding
  Transforms transforms;
};

/// Of two samples or more.
RunSignals signals_of(const CheckedRun& run, std::size_t most_samples);

/// Whether a finding of the run is of this channel: "time", "torque", "hub_angle", ...
bool has_finding(const CheckedRun& run, std::string_view channel);

}  // namespace flexarm::measured
