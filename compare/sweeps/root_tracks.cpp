#include "compare/sweeps/root_tracks.hpp"

#include "compare/sweeps/root_link.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::compare {

namespace {

using Complex = std::complex<double>;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Its z is real.
bool is_single(Complex s, RootPlane plane) {
  return s.imag() == 0.0 || (plane == RootPlane::squared && s.real() == 0.0);
}

/// A root at a place, and where its track was before.
struct Head {
  std::size_t track = 0;
  Complex z;
  std::optional<Complex> before_z;
  double before_place = 0.0;
};

class Tracker {
 public:
  Tracker(const std::function<RootList(double)>& roots_at, const TrackOptions& options)
      : roots_at_(roots_at), options_(options) {}

  void start(double place, const RootList& roots) {
    place_ = place;
    for (const Complex z : unfold(roots, options_)) {
      heads_.push_back({begin_track(TrackEnd::grid, {place, place}), z, std::nullopt, place});
    }
  }

  void step(double place, const RootList& roots) {
    left_ = options_.most_evaluations;
    const std::size_t before = result_.ambiguous.size();
    advance(place, unfold(roots, options_), 0);
    if (result_.ambiguous.size() <= before + 1) return;
    result_.ambiguous[before].to = result_.ambiguous.back().to;
    result_.ambiguous.resize(before + 1);
  }

  /// The heads in the order of the list at the present place.
  const std::vector<Head>& heads() const { return heads_; }
  RootTracks& result() { return result_; }

 private:
  std::size_t begin_track(TrackEnd why, Between where) {
    RootTrack track;
    track.begin = why;
    track.begins = where;
    result_.tracks.push_back(std::move(track));
    return result_.tracks.size() - 1;
  }

  void advance(double place, std::vector<Complex> roots, int halvings) {
    std::vector<Complex> from;
    std::vector<Complex> predicted;
    for (const Head& head : heads_) {
      from.push_back(head.z);
      const double past = place_ - head.before_place;
      predicted.push_back(head.before_z ? predict(*head.before_z, head.z, (place - place_) / past)
                                        : head.z);
    }
    const RootLink link = link_step(from, predicted, roots, options_);
    if (!link.clear && halvings < options_.finest && left_ > 0) {
      --left_;
      const double middle = place_ + (place - place_) / 2.0;
      ++result_.further_evaluations;
      advance(middle, unfold(roots_at_(middle), options_), halvings + 1);
      advance(place, std::move(roots), halvings + 1);
      return;
    }
    if (!link.clear) result_.ambiguous.push_back({place_, place});
    accept(place, roots, link);
  }

  void accept(double place, const std::vector<Complex>& roots, const RootLink& link) {
    const Between where{place_, place};
    std::vector<Head> next(roots.size(), Head{kNone, {}, std::nullopt, place_});
    for (std::size_t j = 0; j < roots.size(); ++j) next[j].z = roots[j];
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      if (link.to[i]) {
        next[*link.to[i]].track = heads_[i].track;
        next[*link.to[i]].before_z = heads_[i].z;
        continue;
      }
      RootTrack& track = result_.tracks[heads_[i].track];
      track.end = at_edge(heads_[i].z, roots) ? TrackEnd::beyond : TrackEnd::lost;
      track.ends = where;
    }
    std::vector<Complex> from;
    for (const Head& head : heads_) from.push_back(head.z);
    for (Head& head : next) {
      if (head.track != kNone) continue;
      head.track = begin_track(at_edge(head.z, from) ? TrackEnd::beyond : TrackEnd::lost, where);
    }
    note_meetings(next, where);
    heads_ = std::move(next);
    place_ = place;
  }

  bool at_edge(Complex z, const std::vector<Complex>& others) const {
    double largest = 0.0;
    for (const Complex other : others) largest = std::max(largest, std::abs(other));
    return std::abs(z) >= options_.edge * largest;
  }

  /// Pairs stand side by side in an unfolded list, the upper root first.
  void note_meetings(const std::vector<Head>& next, Between where) {
    const auto was_real = [](const Head& head) {
      return head.before_z && head.before_z->imag() == 0.0;
    };
    for (std::size_t j = 0; j + 1 < next.size(); ++j) {
      if (next[j].z.imag() > 0.0 && was_real(next[j]) && was_real(next[j + 1])) {
        result_.meetings.push_back({std::min(next[j].track, next[j + 1].track),
                                    std::max(next[j].track, next[j + 1].track), true, where});
      }
    }
    for (std::size_t i = 0; i + 1 < heads_.size(); ++i) {
      if (!(heads_[i].z.imag() > 0.0)) continue;
      const auto back = [&](std::size_t k) {
        const auto found = std::ranges::find(next, heads_[k].track, &Head::track);
        return found != next.end() && found->z.imag() == 0.0;
      };
      if (back(i) && back(i + 1)) {
        result_.meetings.push_back({std::min(heads_[i].track, heads_[i + 1].track),
                                    std::max(heads_[i].track, heads_[i + 1].track), false, where});
      }
    }
  }

  const std::function<RootList(double)>& roots_at_;
  const TrackOptions& options_;
  double place_ = 0.0;
  int left_ = 0;  ///< further evaluations that this step may still have
  std::vector<Head> heads_;
  RootTracks result_;
};

/// Tracks that live between two grid points only have nothing to show.
void drop_tracks_without_points(RootTracks& result) {
  std::vector<std::size_t> new_index(result.tracks.size(), kNone);
  std::vector<RootTrack> kept;
  for (std::size_t t = 0; t < result.tracks.size(); ++t) {
    if (result.tracks[t].s_rad_per_s.empty()) continue;
    new_index[t] = kept.size();
    kept.push_back(std::move(result.tracks[t]));
  }
  std::erase_if(result.meetings, [&](TrackMeeting& meeting) {
    meeting.first = new_index[meeting.first];
    meeting.second = new_index[meeting.second];
    return meeting.first == kNone || meeting.second == kNone;
  });
  result.tracks = std::move(kept);
}

}  // namespace

std::vector<Complex> unfold(const RootList& roots, const TrackOptions& options) {
  std::vector<Complex> unfolded;
  for (const Complex s : roots) {
    const Complex scaled = s / options.scale_rad_per_s;
    const Complex z = options.plane == RootPlane::squared ? scaled * scaled : scaled;
    const bool single = is_single(s, options.plane);
    unfolded.emplace_back(z.real(), single ? 0.0 : z.imag());
    if (!single) unfolded.push_back(std::conj(unfolded.back()));
  }
  return unfolded;
}

std::vector<std::size_t> unfolded_sources(const RootList& roots, RootPlane plane) {
  std::vector<std::size_t> sources;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    sources.insert(sources.end(), is_single(roots[i], plane) ? 1 : 2, i);
  }
  return sources;
}

RootTracks track_roots(const std::vector<RootList>& at_grid,
                       const std::function<RootList(double place)>& roots_at,
                       const TrackOptions& options) {
  Tracker tracker(roots_at, options);
  for (std::size_t k = 0; k < at_grid.size(); ++k) {
    const auto place = static_cast<double>(k);
    if (k == 0) {
      tracker.start(place, at_grid[k]);
    } else {
      tracker.step(place, at_grid[k]);
    }
    const auto sources = unfolded_sources(at_grid[k], options.plane);
    const auto& heads = tracker.heads();
    for (std::size_t j = 0; j < heads.size(); ++j) {
      RootTrack& track = tracker.result().tracks[heads[j].track];
      if (track.s_rad_per_s.empty()) track.first = k;
      track.s_rad_per_s.push_back(at_grid[k][sources[j]]);
      track.unfolded.push_back(j);
      track.ends = {place, place};
    }
  }
  RootTracks result = std::move(tracker.result());
  drop_tracks_without_points(result);
  return result;
}

std::vector<std::optional<std::size_t>> link_roots(
    const RootList& from, const RootList& to, const std::function<RootList(double place)>& roots_at,
    double from_place, const TrackOptions& options, int& further_evaluations) {
  Tracker tracker(roots_at, options);
  tracker.start(from_place, from);
  tracker.step(from_place + 1.0, to);
  std::vector<std::optional<std::size_t>> links(tracker.result().tracks.size());
  for (std::size_t j = 0; j < tracker.heads().size(); ++j) {
    links[tracker.heads()[j].track] = j;
  }
  links.resize(unfold(from, options).size());
  further_evaluations += tracker.result().further_evaluations;
  return links;
}

}  // namespace flexarm::compare
