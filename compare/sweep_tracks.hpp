#pragma once

#include "compare/sweep_result.hpp"

#include <cstddef>
#include <vector>

namespace flexarm::compare {

/// The tracks of one sensor's zeros over the whole grid.
struct GridTracks {
  /// [track][point]: index in the reference's list of the point, or kNoRoot.
  std::vector<std::vector<std::size_t>> index;
  std::vector<SweepEvent> events;
  std::size_t further_evaluations = 0;
};

inline constexpr std::size_t kNoRoot = static_cast<std::size_t>(-1);

/// Tracks the zeros of sensor `sensor` of the task's questions, by its first model. Tracks that
/// never are among the zeros asked for are left out.
GridTracks track_grid(const SweepTask& task, const std::vector<SweepPoint>& reference,
                      std::size_t sensor, const SweepRun& run);

}  // namespace flexarm::compare
