#include "diagnose/predictors/run_filters.hpp"

namespace flexarm::diagnose {

RunFilters::RunFilters(std::size_t runs) {
  for (std::size_t r = 0; r < runs; ++r) kept_.emplace_back(kKept);
}

std::shared_ptr<const RunFilter> RunFilters::of(std::size_t run,
                                                const response::ArmSimulator& simulation,
                                                const RecordedRun& recorded) {
  return kept_[run].of(simulation.sampled(recorded.process, recorded.deviations),
                       [&](const response::SampledSystem& system) {
                         return run_filter(simulation, system, recorded);
                       });
}

}  // namespace flexarm::diagnose
