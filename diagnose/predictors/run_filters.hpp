#pragma once

#include "diagnose/predictors/filtered_run.hpp"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace flexarm::diagnose {

/// Kalman filters of the runs of an experiment: of each run the last `kKept` are kept. Of the
/// parameters that a fit moves, many leave the linear arm and its sensors as they are: laws of hub
/// torque, the path of the torque. Concurrent calls are safe, and give what a computation would; of
/// the same filter they may both compute it.
class RunFilters {
 public:
  explicit RunFilters(std::size_t runs) : kept_(runs) {}

  /// The filter of that run, which is `recorded` as in each call for it but for the noise. Throws
  /// InputError as response::ArmSimulator::sampled and run_filter.
  std::shared_ptr<const RunFilter> of(std::size_t run, const response::ArmSimulator& simulation,
                                      const RecordedRun& recorded);
  static constexpr std::size_t kKept = 4;

 private:
  struct Entry {
    response::SampledSystem system;  ///< all that a filter depends on
    std::shared_ptr<const RunFilter> filter;
  };

  std::mutex mutex_;                      // of what follows
  std::vector<std::vector<Entry>> kept_;  // of each run, the last used at the end
};

}  // namespace flexarm::diagnose
