#include "compare/sweeps/sweep_tracks.hpp"

#include "arm/linear_arm.hpp"
#include "compare/sweeps/root_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>
#include <utility>

namespace flexarm::compare {

namespace {

/// A row of the grid: all points of one value of the first of two axes, or the whole of one axis.
struct Row {
  RootTracks tracks;
  std::vector<std::size_t> name;  ///< [track]: the track of the grid
};

class GridTracker {
 public:
  GridTracker(const SweepTask& task, const TrackedRoots& roots, const SweepRun& run)
      : task_(task),
        roots_(roots),
        run_(run),
        columns_(task.axes.back().values.size()),
        rows_(task.points() / columns_) {
    options_.scale_rad_per_s = arm::omega_scale_rad_per_s(task.arm_of(0));
    options_.plane = roots.family.zeros_of ? RootPlane::squared : RootPlane::plain;
  }

  GridTracks track() {
    std::vector<Row> rows(rows_);
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
      rows[i].tracks = track_roots(
          lists_of_row(i), [this, i](double place) { return roots_at(i, place); }, options_);
    });
    name(rows);
    GridTracks result = gather(rows);
    result.further_evaluations = further_evaluations_;
    return result;
  }

 private:
  const RootList& list(std::size_t row, std::size_t column) const {
    return roots_.at_points[row * columns_ + column];
  }

  std::vector<RootList> lists_of_row(std::size_t row) const {
    std::vector<RootList> lists;
    for (std::size_t j = 0; j < columns_; ++j) lists.push_back(list(row, j));
    return lists;
  }

  /// The roots between two grid points.
  RootList roots_at_places(const std::vector<double>& places) const {
    if (run_.stop != nullptr && run_.stop->load()) {
      throw SweepInterrupted(task_.points(), task_.points());
    }
    return roots_.roots_of(task_.models.front().make(arm_at(task_.arm, task_.axes, places)));
  }

  RootList roots_at(std::size_t row, double place) const {
    std::vector<double> places = {static_cast<double>(row), place};
    if (task_.axes.size() == 1) places.erase(places.begin());
    return roots_at_places(places);
  }

  /// The index in the row before of each unfolded root of a row, at one column.
  std::vector<std::size_t> linked_from(std::size_t row, std::size_t column) {
    int further = 0;
    const auto links = link_roots(
        list(row - 1, column), list(row, column),
        [&](double place) {
          return roots_at_places({place, static_cast<double>(column)});
        },
        static_cast<double>(row - 1), options_, further);
    further_evaluations_ += static_cast<std::size_t>(further);
    std::vector<std::size_t> from(unfold(list(row, column), options_).size(), kNoRoot);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i]) from[*links[i]] = i;
    }
    return from;
  }

  static const std::size_t* root_of(const RootTrack& track, std::size_t column) {
    if (column < track.first || column >= track.first + track.unfolded.size()) return nullptr;
    return &track.unfolded[column - track.first];
  }

  /// The grid's track that holds the unfolded root `root` at a point, or kNoRoot.
  static std::size_t name_at(const Row& row, std::size_t column, std::size_t root) {
    for (std::size_t t = 0; t < row.tracks.tracks.size(); ++t) {
      const std::size_t* own = root_of(row.tracks.tracks[t], column);
      if (own != nullptr && *own == root) return row.name[t];
    }
    return kNoRoot;
  }

  static bool overlap(const RootTrack& a, const RootTrack& b) {
    return a.first < b.first + b.unfolded.size() && b.first < a.first + a.unfolded.size();
  }

  /// Tracks of a row take the names of those that they continue in the row before, at the column
  /// where they begin; a track without such a one has a name of its own.
  void name(std::vector<Row>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Row& row = rows[i];
      const auto& tracks = row.tracks.tracks;
      row.name.assign(tracks.size(), kNoRoot);
      further_evaluations_ += static_cast<std::size_t>(row.tracks.further_evaluations);
      std::vector<std::vector<std::size_t>> links(columns_);
      for (std::size_t t = 0; t < tracks.size(); ++t) {
        const std::size_t column = tracks[t].first;
        std::size_t inherited = kNoRoot;
        if (i > 0) {
          if (links[column].empty()) links[column] = linked_from(i, column);
          const std::size_t root = links[column][tracks[t].unfolded.front()];
          if (root != kNoRoot) inherited = name_at(rows[i - 1], column, root);
        }
        for (std::size_t other = 0; other < t && inherited != kNoRoot; ++other) {
          if (row.name[other] == inherited && overlap(tracks[t], tracks[other])) {
            inherited = kNoRoot;
          }
        }
        row.name[t] = inherited != kNoRoot ? inherited : names_++;
      }
    }
  }

  GridTracks gather(const std::vector<Row>& rows) const {
    GridTracks all;
    all.index.assign(names_, std::vector<std::size_t>(task_.points(), kNoRoot));
    std::vector<bool> is_wanted(names_, false);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t t = 0; t < rows[i].name.size(); ++t) {
        const RootTrack& track = rows[i].tracks.tracks[t];
        for (std::size_t k = 0; k < track.unfolded.size(); ++k) {
          const std::size_t column = track.first + k;
          const auto sources = unfolded_sources(list(i, column), options_.plane);
          const std::size_t index = sources[track.unfolded[k]];
          if (is_lower_pole(sources, track.unfolded[k])) continue;
          all.index[rows[i].name[t]][i * columns_ + column] = index;
          if (index < roots_.wanted) is_wanted[rows[i].name[t]] = true;
        }
      }
    }
    std::vector<std::size_t> number(names_, kNoRoot);
    GridTracks result;
    for (std::size_t n = 0; n < names_; ++n) {
      if (!is_wanted[n]) continue;
      number[n] = result.index.size();
      result.index.push_back(std::move(all.index[n]));
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      add_events(rows[i], i, number, result.events);
    }
    add_seams(result.index, result.events);
    return result;
  }

  /// The second of the two that one complex pole unfolds to.
  bool is_lower_pole(const std::vector<std::size_t>& sources, std::size_t unfolded) const {
    return options_.plane == RootPlane::plain && unfolded > 0 &&
           sources[unfolded - 1] == sources[unfolded];
  }

  SweepEvent event(SweepEvent::Kind kind, std::size_t row, const Between& where) const {
    const SweepAxis& axis = task_.axes.back();
    return {kind, roots_.family, kNoTrack, kNoTrack, row, axis.at(where.from), axis.at(where.to)};
  }

  void add_events(const Row& row, std::size_t i, const std::vector<std::size_t>& number,
                  std::vector<SweepEvent>& events) const {
    using Kind = SweepEvent::Kind;
    const auto number_of = [&](std::size_t track) {
      const std::size_t n = number[row.name[track]];
      return n == kNoRoot ? kNoTrack : static_cast<int>(n) + 1;
    };
    const auto add = [&](Kind kind, std::size_t track, std::size_t other, const Between& where) {
      SweepEvent happened = event(kind, i, where);
      happened.track = number_of(track);
      happened.other = other == kNoRoot ? kNoTrack : number_of(other);
      if (happened.track != kNoTrack || happened.other != kNoTrack) events.push_back(happened);
    };
    for (std::size_t t = 0; t < row.tracks.tracks.size(); ++t) {
      const RootTrack& track = row.tracks.tracks[t];
      if (track.begin != TrackEnd::grid) {
        add(track.begin == TrackEnd::beyond ? Kind::appears_beyond : Kind::appears, t, kNoRoot,
            track.begins);
      }
      if (track.end != TrackEnd::grid) {
        add(track.end == TrackEnd::beyond ? Kind::leaves_beyond : Kind::vanishes, t, kNoRoot,
            track.ends);
      }
    }
    for (const TrackMeeting& meeting : row.tracks.meetings) {
      add(meeting.to_conjugates ? Kind::meet : Kind::part, meeting.first, meeting.second,
          meeting.where);
    }
    for (const Between& where : row.tracks.ambiguous) {
      events.push_back(event(Kind::ambiguous, i, where));
    }
  }

  /// A track that at the next row is much nearer to another track than to itself.
  void add_seams(const std::vector<std::vector<std::size_t>>& index,
                 std::vector<SweepEvent>& events) const {
    for (std::size_t point = columns_; point < task_.points(); ++point) {
      const std::size_t before = point - columns_;
      for (std::size_t n = 0; n < index.size(); ++n) {
        if (index[n][before] == kNoRoot || index[n][point] == kNoRoot) continue;
        const auto from = roots_.at_points[before][index[n][before]];
        const auto distance_to = [&](std::size_t other) {
          const auto s = roots_.at_points[point][index[other][point]];
          return std::abs(s - from) / std::abs(from);
        };
        const double own = distance_to(n);
        bool fits = own < kSeamStep;
        for (std::size_t other = 0; other < index.size() && !fits; ++other) {
          const bool elsewhere = other != n && index[other][point] != kNoRoot;
          if (elsewhere && distance_to(other) * options_.clearance < own) break;
          fits = other + 1 == index.size();
        }
        if (fits) continue;
        const auto column = static_cast<double>(point % columns_);
        SweepEvent seam = event(SweepEvent::Kind::seam, point / columns_, {column, column});
        seam.track = static_cast<int>(n) + 1;
        events.push_back(seam);
      }
    }
  }

  static constexpr double kSeamStep = 0.02;  // of |s|: a smaller one is no jump

  const SweepTask& task_;
  const TrackedRoots& roots_;
  const SweepRun& run_;
  const std::size_t columns_;
  const std::size_t rows_;
  TrackOptions options_;
  std::size_t names_ = 0;
  std::size_t further_evaluations_ = 0;
};

}  // namespace

GridTracks track_grid(const SweepTask& task, const TrackedRoots& roots, const SweepRun& run) {
  return GridTracker(task, roots, run).track();
}

}  // namespace flexarm::compare
