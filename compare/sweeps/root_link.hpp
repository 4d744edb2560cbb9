#pragma once

#include "compare/sweeps/root_tracks.hpp"

#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::compare {

/// One step of tracking: which root follows which prediction.
struct RootLink {
  std::vector<std::optional<std::size_t>> to;  ///< [prediction]: index of a root, or none
  bool clear = true;                           ///< no other pairing is nearly as good
};

/// Pairs predictions with roots, both unfolded z; `from` holds the roots that the
/// predictions are of, in the same order.
RootLink link_step(std::span<const std::complex<double>> from,
                   std::span<const std::complex<double>> predicted,
                   std::span<const std::complex<double>> roots, const TrackOptions& options);

/// The z that a root is expected at after a step `ratio` times as long as that from `before` to
/// `now`. Along a line in ln z, so that a root on an axis stays on it; in z near zero; `now` itself
/// after a step that was long.
std::complex<double> predict(std::complex<double> before, std::complex<double> now, double ratio);

}  // namespace flexarm::compare
