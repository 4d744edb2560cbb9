#include "response/time/reading_plan.hpp"

namespace flexarm::response {

ReadingPlan::ReadingPlan(const ReadingTimes& times, std::span<const std::size_t> sensors,
                         const TorquePath& path, std::size_t samples)
    : samples_(static_cast<std::ptrdiff_t>(samples)) {
  for (const std::size_t j : sensors) {
    const auto& [at, samples_later] = times.sensors[j];
    entries_.push_back({j, path.part_from(at), samples_later});
  }
}

}  // namespace flexarm::response
