#include "exact_tf/root_search.hpp"

#include "exact_tf/root_count.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace flexarm::exact_tf {

namespace {

using CountBelow = int (*)(const InertiaRatios&, Real);
using Characteristic = Scaled<Real> (*)(const InertiaRatios&, const Real&);

/// [low, high] with the number of roots below either end.
struct Bracket {
  Real low;
  int below_low;
  Real high;
  int below_high;
};

RealRoots find_roots(CountBelow count_below, Characteristic characteristic,
                     const InertiaRatios& ratios, int count, const RootSearchOptions& options) {
  if (count < 1 || count > kMostRoots) {
    throw std::invalid_argument("count of roots must be from 1 to kMostRoots");
  }
  constexpr Real kPi = std::numbers::pi_v<Real>;
  constexpr Real kNarrowest = 4.0L * std::numeric_limits<Real>::epsilon();
  const boost::math::tools::eps_tolerance<Real> tolerance(options.significand_bits);
  const auto value = [&](Real lambda) { return characteristic(ratios, lambda).value; };

  RealRoots roots;
  roots.summary.method = "Wittrick-Williams count, TOMS 748; residual: widest bracket over lambda";
  roots.count.method = "Wittrick-Williams";
  Real above_last = 0.0L;
  // The clamped beam alone has more than lambda/pi - 2 roots below lambda, the arm no fewer than
  // one less.
  const Real end = (static_cast<Real>(count) + 3.0L) * kPi;
  std::vector<Bracket> open = {{0.0L, 0, end, count_below(ratios, end)}};
  while (!open.empty() && std::ssize(roots.lambda) < count) {
    const Bracket bracket = open.back();
    open.pop_back();
    const int inside = bracket.below_high - bracket.below_low;
    if (inside == 0) continue;
    if (inside == 1) {
      auto values = static_cast<std::uintmax_t>(options.maximum_function_values);
      const auto [low, high] =
          boost::math::tools::toms748_solve(value, bracket.low, bracket.high, tolerance, values);
      const Real width = (high - low) / high;
      roots.lambda.push_back(0.5L * (low + high));
      roots.summary.iterations += static_cast<int>(values);
      roots.summary.largest_residual =
          std::max(roots.summary.largest_residual, static_cast<double>(width));
      roots.summary.converged &= static_cast<int>(values) < options.maximum_function_values;
      above_last = high;
      continue;
    }
    const Real middle = 0.5L * (bracket.low + bracket.high);
    if (bracket.high - bracket.low <= kNarrowest * bracket.high) {
      // Roots that the arithmetic cannot tell apart.
      const int wanted = std::min(inside, count - static_cast<int>(std::ssize(roots.lambda)));
      roots.lambda.insert(roots.lambda.end(), static_cast<std::size_t>(wanted), middle);
      above_last = bracket.high;
      continue;
    }
    const int below_middle = count_below(ratios, middle);
    ++roots.summary.iterations;
    open.push_back({middle, below_middle, bracket.high, bracket.below_high});
    open.push_back({bracket.low, bracket.below_low, middle, below_middle});
  }
  roots.count.found = static_cast<int>(std::ssize(roots.lambda));
  roots.count.expected = count_below(ratios, above_last * (1.0L + kNarrowest));
  return roots;
}

}  // namespace

RealRoots find_poles(const InertiaRatios& ratios, int count, const RootSearchOptions& options) {
  return find_roots(count_poles_below, pole_characteristic<Real>, ratios, count, options);
}

RealRoots find_hub_zeros(const InertiaRatios& ratios, int count, const RootSearchOptions& options) {
  return find_roots(count_hub_zeros_below, hub_angle_numerator<Real>, ratios, count, options);
}

}  // namespace flexarm::exact_tf
