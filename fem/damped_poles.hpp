#pragma once

#include "fem/discretisation.hpp"

#include <complex>
#include <vector>

namespace flexarm::fem {

/// The two roots that one undamped pair becomes, dimensionless: conjugates, `first` with Im > 0, or
/// two real ones, `first` the nearer to 0.
struct RootPair {
  std::complex<double> first;
  std::complex<double> second;
};

/// Roots s of (s^2 M + s C + K) u = 0.
struct DampedRoots {
  std::vector<RootPair> pairs;  ///< of the lowest mode, then of the flexible ones in their order
  int iterations = 0;           ///< factorisations of the quadratic pencil
  double largest_change = 0.0;  ///< of a root at its last iteration, relative to it
  bool converged = false;       ///< all settled, none twice, and the continuation was certain
};

/// The lowest pair and the `count` lowest flexible ones, all of them where there are fewer.
///
/// The pencil is projected on undamped modes with the hub free and held: what little and what very
/// strong friction leave. There each pair is followed from no damping (see continue_damping). Each
/// root is then refined on the whole model by inverse iteration, T(s) y = M x, and the root nearest
/// to s of y^T T(s) y = 0, whose error is of second order in that of y. `tolerance` is that of the
/// undamped modes (see vibration_modes).
DampedRoots damped_roots(const Discretisation& discretisation, int count, double tolerance);

}  // namespace flexarm::fem
