#pragma once

#include "compare/sweeps/root_tracks.hpp"
#include "compare/sweeps/sweep_result.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace flexarm::compare {

/// The roots to follow over a grid, of the task's first model.
struct TrackedRoots {
  SweepFamily family;
  std::vector<RootList> at_points;  ///< [point]
  std::function<RootList(const response::AnyFormulation&)> roots_of;
  std::size_t wanted = 0;  ///< a track matters when once it is among so many of the list
};

/// The tracks of a family over the whole grid.
struct GridTracks {
  /// [track][point]: index in the list of the point, or kNoRoot.
  std::vector<std::vector<std::size_t>> index;
  std::vector<SweepEvent> events;
  std::size_t further_evaluations = 0;
};

inline constexpr std::size_t kNoRoot = static_cast<std::size_t>(-1);

/// Tracks that do not matter are left out. Of the two tracks of conjugate poles the lower one has
/// no root where it is complex.
GridTracks track_grid(const SweepTask& task, const TrackedRoots& roots, const SweepRun& run);

}  // namespace flexarm::compare
