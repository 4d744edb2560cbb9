#pragma once

#include "diagnose/predictors/filtered_run.hpp"
#include "diagnose/predictors/last_kept.hpp"

#include <cstddef>
#include <deque>
#include <memory>

namespace flexarm::diagnose {

/// Kalman filters of the runs of an experiment: of each run the last `kKept` are kept. Of the
/// parameters that a fit moves, many leave the linear arm and its sensors as they are: laws of hub
/// torque, the path of the torque. Concurrent calls are safe.
class RunFilters {
 public:
  explicit RunFilters(std::size_t runs);

  /// The filter of that run, which is `recorded` as in each call for it but for the noise. Throws
  /// InputError as response::ArmSimulator::sampled and run_filter.
  std::shared_ptr<const RunFilter> of(std::size_t run, const response::ArmSimulator& simulation,
                                      const RecordedRun& recorded);
  static constexpr std::size_t kKept = 4;

 private:
  /// One a run, by the system, which is all that a filter depends on.
  std::deque<LastKept<response::SampledSystem, RunFilter>> kept_;
};

}  // namespace flexarm::diagnose
