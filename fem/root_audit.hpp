#pragma once

#include "fem/pole_free_numerator.hpp"

#include <complex>
#include <cstddef>
#include <span>

namespace flexarm::fem {

/// What the argument principle says of the first roots of a list.
struct RootAudit {
  /// How many roots there are up to the last of them, conjugate pairs once; -1 when it cannot be
  /// told.
  int expected = -1;
  /// Leading roots with none missing among or before them; all of them when it cannot be told.
  std::size_t complete = 0;
};

/// The modulus that parts w[k - 1] from w[k]: their geometric mean; a little outside the last,
/// and well inside the first. `w` is not empty and ascending in |w|; k is 0 to w.size().
double radius_before(std::span<const std::complex<double>> w, std::size_t k);

/// Counts the roots within the circle beyond w[looked_at - 1], looked_at >= 1; where their number
/// differs, finds the first gap by bisection. `w` holds one of each conjugate pair, ascending.
RootAudit audit(std::span<const std::complex<double>> w, std::size_t looked_at,
                const PoleFreeNumerator& numerator);

}  // namespace flexarm::fem
