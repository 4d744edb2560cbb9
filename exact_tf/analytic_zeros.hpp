#pragma once

#include "exact_tf/argument_principle.hpp"
#include "exact_tf/arithmetic.hpp"

#include <vector>

namespace flexarm::exact_tf {

/// Where a zero lies: at real z > 0 (lambda real), at real z < 0 (arg lambda = pi/4), or, with its
/// conjugate, off the real axis of z.
enum class ZeroLocus { positive_axis, negative_axis, off_axis };

struct AnalyticZero {
  ZeroLocus locus = ZeroLocus::positive_axis;
  Complex lambda;  ///< in the sector 0 <= arg lambda <= pi/4

  /// Zeros in z that this one stands for.
  int multiplicity() const { return locus == ZeroLocus::off_axis ? 2 : 1; }
};

struct AnalyticZeroOptions {
  /// Real zeros are first looked for as changes of sign on a grid of this step in |lambda|. What
  /// the grid misses the count reveals.
  Real axis_step = 1.5L;
  /// A bracket on an axis is narrowed until its width <= 2^(1 - significand_bits) |lambda|.
  unsigned significand_bits = 62;
  /// A zero off the axes is accepted once |step of the secant method| <= this |lambda|.
  Real secant_tolerance = 1e-16L;
  /// Boxes that hold what is missing are cut until their size <= this |lambda|.
  Real smallest_box = 1e-10L;
  /// With false, zeros that the grid missed are counted but not looked for.
  bool locate_missing = true;
  /// The search ends unfinished after about this many values.
  long most_function_values = 50'000'000;
  ContourOptions contour;
};

/// Those of a function that is evaluated in `arithmetic`: brackets and steps end where rounding of
/// the values does not yet decide.
AnalyticZeroOptions zero_options(Arithmetic arithmetic);

/// Zeros of an entire function beside their number.
struct AnalyticZeros {
  std::vector<AnalyticZero> zeros;  ///< |lambda| ascending and < radius, double ones twice
  Real radius = 0.0L;               ///< |lambda| of the contour along which they are counted
  int counted = 0;  ///< zeros in |z| < radius^4 by the argument principle, conjugates included
  int found = 0;    ///< sum of multiplicity() over `zeros`
  /// found == counted, as many zeros as asked for, every contour resolved, every bracket narrowed.
  bool converged = false;
  long function_values = 0;  ///< of N

  int missing() const { return counted - found; }
};

/// All zeros of N up to at least the `count`-th (one of each conjugate pair; more where the contour
/// takes them in), in order of |z|. N(0) must not be zero.
///
/// Both half axes are searched by changes of sign and TOMS 748, and the argument of N along
/// |lambda| = const counts all. What is missing is enclosed by counting in polar boxes, cut in
/// halves; then a double or nearly double zero is taken apart at the extremum of N on the axis, and
/// one off the axes is found by the secant method.
AnalyticZeros find_analytic_zeros(const SectorFunction& function, int count,
                                  const AnalyticZeroOptions& options = {});

}  // namespace flexarm::exact_tf
