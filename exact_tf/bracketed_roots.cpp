#include "exact_tf/bracketed_roots.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace flexarm::exact_tf {

RealRoots find_bracketed_roots(const CountedFunction& function, const CountedInterval& interval,
                               int count, const RootSearchOptions& options) {
  constexpr Real kNarrowest = 4.0L * std::numeric_limits<Real>::epsilon();
  const boost::math::tools::eps_tolerance<Real> tolerance(options.significand_bits);
  const auto narrow = [](const CountedInterval& bracket) {
    return bracket.high - bracket.low <=
           kNarrowest * std::max(std::abs(bracket.low), std::abs(bracket.high));
  };

  RealRoots roots;
  roots.summary.method = "Wittrick-Williams count, TOMS 748; residual: widest bracket over lambda";
  roots.count.method = "Wittrick-Williams";
  Real above_last = interval.low;
  bool all_narrowed = true;
  std::vector<CountedInterval> open = {interval};
  while (!open.empty() && std::ssize(roots.lambda) < count) {
    const CountedInterval bracket = open.back();
    open.pop_back();
    const int inside = bracket.below_high - bracket.below_low;
    if (inside == 0) continue;
    if (inside == 1) {
      auto values = static_cast<std::uintmax_t>(options.maximum_function_values);
      const auto [low, high] = boost::math::tools::toms748_solve(function.value, bracket.low,
                                                                 bracket.high, tolerance, values);
      const Real width = (high - low) / std::abs(high);
      roots.lambda.push_back(0.5L * (low + high));
      roots.summary.iterations += static_cast<int>(values);
      roots.summary.largest_residual =
          std::max(roots.summary.largest_residual, static_cast<double>(width));
      all_narrowed = all_narrowed && static_cast<int>(values) < options.maximum_function_values;
      above_last = high;
      continue;
    }
    const Real middle = 0.5L * (bracket.low + bracket.high);
    if (narrow(bracket)) {
      // Roots that the arithmetic cannot tell apart.
      const int wanted = std::min(inside, count - static_cast<int>(std::ssize(roots.lambda)));
      roots.lambda.insert(roots.lambda.end(), static_cast<std::size_t>(wanted), middle);
      above_last = bracket.high;
      continue;
    }
    const int below_middle = function.count_below(middle);
    ++roots.summary.iterations;
    open.push_back({middle, below_middle, bracket.high, bracket.below_high});
    open.push_back({bracket.low, bracket.below_low, middle, below_middle});
  }
  roots.summary.converged = all_narrowed;
  roots.count.found = static_cast<int>(std::ssize(roots.lambda));
  // Just above the last root, where rounding of an ill-conditioned function leaves its sign open:
  // as far above as the digits of a double reach.
  constexpr Real kDouble = std::numeric_limits<double>::epsilon();
  for (const Real margin : {kNarrowest, 0.25L * kDouble, 4.0L * kDouble}) {
    const Real above = above_last + margin * std::abs(above_last);
    roots.count.expected = function.count_below(above) - interval.below_low;
    if (roots.count.expected == roots.count.found) break;
  }
  return roots;
}

}  // namespace flexarm::exact_tf
