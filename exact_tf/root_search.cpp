#include "exact_tf/root_search.hpp"

#include "exact_tf/root_count.hpp"

#include <numbers>
#include <stdexcept>

namespace flexarm::exact_tf {

namespace {

using CountBelow = int (*)(const InertiaRatios&, Real);
using Characteristic = Scaled<Real> (*)(const InertiaRatios&, const Real&);

RealRoots find_roots(CountBelow count_below, Characteristic characteristic,
                     const InertiaRatios& ratios, int count, const RootSearchOptions& options) {
  if (count < 1 || count > kMostRoots) {
    throw std::invalid_argument("count of roots must be from 1 to kMostRoots");
  }
  const CountedFunction function = {
      [&](Real lambda) { return count_below(ratios, lambda); },
      [&](Real lambda) { return characteristic(ratios, lambda).value; }};
  // The clamped beam alone has more than lambda/pi - 2 roots below lambda, the arm no fewer than
  // one less.
  const Real end = (static_cast<Real>(count) + 3.0L) * std::numbers::pi_v<Real>;
  return find_bracketed_roots(function, {0.0L, 0, end, count_below(ratios, end)}, count, options);
}

}  // namespace

RealRoots find_poles(const InertiaRatios& ratios, int count, const RootSearchOptions& options) {
  return find_roots(count_poles_below, pole_characteristic<Real>, ratios, count, options);
}

RealRoots find_hub_zeros(const InertiaRatios& ratios, int count, const RootSearchOptions& options) {
  return find_roots(count_hub_zeros_below, hub_angle_numerator<Real>, ratios, count, options);
}

}  // namespace flexarm::exact_tf
