#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace flexarm::compare {

/// Roots at one place, one of each set of mirror images.
using RootList = std::vector<std::complex<double>>;

/// In which plane roots move smoothly, and which mirror images one stands for.
enum class RootPlane {
  squared,  ///< z = s^2; +-s, +-conj(s): zeros of an undamped arm, as in arm::ZeroSet
  plain,    ///< z = s; s, conj(s): poles of a damped arm, Im >= 0
};

/// Why a track begins or ends.
enum class TrackEnd {
  grid,    ///< at the first or last point of the grid
  beyond,  ///< its |s| passes that of the largest root of the list
  lost,    ///< inside the list: no root continues it that is near enough
};

/// Places on the grid between which something happens; integers are grid points.
struct Between {
  double from = 0.0;
  double to = 0.0;

  bool operator==(const Between&) const = default;
};

/// One root followed over the grid points first to first + s.size() - 1.
struct RootTrack {
  std::size_t first = 0;
  RootList s_rad_per_s;               ///< one a point
  std::vector<std::size_t> unfolded;  ///< its index in `unfold` of the point's list
  TrackEnd begin = TrackEnd::grid;
  Between begins;
  TrackEnd end = TrackEnd::grid;
  Between ends;
};

/// Two tracks of real z that meet and become conjugate, or that return to the real axis of z.
/// Which of the two is which beyond is a matter of naming.
struct TrackMeeting {
  std::size_t first = 0;
  std::size_t second = 0;
  bool to_conjugates = true;
  Between where;
};

/// Tracks in the order of their roots in the lists where they begin.
struct RootTracks {
  std::vector<RootTrack> tracks;
  std::vector<TrackMeeting> meetings;
  std::vector<Between> ambiguous;  ///< parts of grid steps that stayed so, however divided
  int further_evaluations = 0;     ///< of `roots_at` between grid points
};

struct TrackOptions {
  /// A track that came and goes within |s| <= scale may pass through s = 0.
  double scale_rad_per_s = 1.0;
  RootPlane plane = RootPlane::squared;
  /// A root z is taken for the prediction p when |z - p| <= largest_step times their mean
  /// modulus, and when no other pair with either is nearer than `clearance` times that.
  double largest_step = 0.25;
  double clearance = 3.0;
  /// A root may enter or leave the list when |z| >= edge times the list's largest.
  double edge = 0.5;
  int finest = 20;             ///< a step is halved at most so often,
  int most_evaluations = 100;  ///< and with at most so many further evaluations
};

/// Follows the roots from one list to the next. A real function's roots in z are real or conjugate,
/// and move continuously, through s = 0 and through collisions too: each step predicts
/// every z from its last two values and assigns predictions to roots at the least total distance.
/// A step that is ambiguous is halved, `roots_at(place)` giving the roots in between, until it is
/// clear or as fine as `finest` allows.
RootTracks track_roots(const std::vector<RootList>& at_grid,
                       const std::function<RootList(double place)>& roots_at,
                       const TrackOptions& options);

/// z of every root in units of the scale, both of a conjugate pair: the upper one, then the lower.
std::vector<std::complex<double>> unfold(const RootList& roots, const TrackOptions& options);
/// The index in the list of each unfolded root.
std::vector<std::size_t> unfolded_sources(const RootList& roots, RootPlane plane);

/// For each unfolded root at the grid point `from` its index at the next one, or empty: one step of
/// `track_roots` without a past.
std::vector<std::optional<std::size_t>> link_roots(
    const RootList& from, const RootList& to, const std::function<RootList(double place)>& roots_at,
    double from_place, const TrackOptions& options, int& further_evaluations);

}  // namespace flexarm::compare
