#include "diagnose/predictors/run_filters.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::diagnose {

std::shared_ptr<const RunFilter> RunFilters::of(std::size_t run,
                                                const response::ArmSimulator& simulation,
                                                const RecordedRun& recorded) {
  response::SampledSystem system = simulation.sampled(recorded.process, recorded.deviations);
  {
    const std::lock_guard lock(mutex_);
    std::vector<Entry>& entries = kept_[run];
    const auto found = std::ranges::find(entries, system, &Entry::system);
    if (found != entries.end()) {
      std::rotate(found, found + 1, entries.end());
      return entries.back().filter;
    }
  }
  auto filter = std::make_shared<const RunFilter>(run_filter(simulation, system, recorded));
  const std::lock_guard lock(mutex_);
  std::vector<Entry>& entries = kept_[run];
  if (entries.size() == kKept) entries.erase(entries.begin());
  entries.push_back({std::move(system), filter});
  return filter;
}

}  // namespace flexarm::diagnose
