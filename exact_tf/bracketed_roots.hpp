#pragma once

#include "arm/formulation.hpp"
#include "exact_tf/scaled.hpp"

#include <functional>
#include <vector>

namespace flexarm::exact_tf {

struct RootSearchOptions {
  /// A bracket is narrowed until its width <= 2^(1 - significand_bits) lambda.
  unsigned significand_bits = 61;
  /// Function values allowed to a root after its isolation.
  int maximum_function_values = 200;
};

/// Roots on the real lambda axis, ascending, with the proof that they are all: `count` compares
/// them with the count above the last, by 1e-15 of it at most.
struct RealRoots {
  std::vector<Real> lambda;
  arm::RootCount count;
  arm::SolveSummary summary;  ///< largest_residual: widest final bracket over its lambda
};

/// A real function of which the number of roots below any argument is known.
struct CountedFunction {
  std::function<int(Real)> count_below;
  std::function<Real(Real)> value;  ///< its sign changes with the parity of the count
};

/// An interval with the number of roots below either end.
struct CountedInterval {
  Real low = 0.0L;
  int below_low = 0;
  Real high = 0.0L;
  int below_high = 0;
};

/// The `count` lowest roots in the interval, which holds as many: isolated by halving, then by TOMS
/// 748. `count.found` and `count.expected` are numbers of roots above interval.low.
RealRoots find_bracketed_roots(const CountedFunction& function, const CountedInterval& interval,
                               int count, const RootSearchOptions& options = {});

}  // namespace flexarm::exact_tf
