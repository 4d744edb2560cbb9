#include "exact_tf/chain_eigenvalues.hpp"

#include "exact_tf/bracketed_roots.hpp"
#include "exact_tf/chain_count.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::exact_tf {

namespace {

/// omega^2 by the variable of the search, which is lambda where omega^2 > 0.
Real omega_squared_at(Real lambda) {
  const Real square = lambda * lambda;
  return std::copysign(square * square, lambda);
}

ChainCount count_at(const ArmInBeamUnits& arm, Real lambda) {
  return count_below(TransferChain<Real>(arm, undamped_at(arm, omega_squared_at(lambda))));
}

/// The `count` lowest roots above `low`.
RealRoots lowest_roots(const CountedFunction& function, Real low, int count) {
  CountedInterval interval{low, function.count_below(low), 0.0L, 0};
  for (interval.high = (static_cast<Real>(count) + 2.0L) * std::numbers::pi_v<Real>;
       (interval.below_high = function.count_below(interval.high)) - interval.below_low < count;) {
    interval.high *= 1.5L;
  }
  return find_bracketed_roots(function, interval, count);
}

/// Where no eigenvalue is lower.
Real below_all(const CountedFunction& function) {
  if (function.count_below(0.0L) == 0) return 0.0L;
  Real low = -1.0L;
  while (function.count_below(low) > 0) low *= 2.0L;
  return low;
}

ChainEigenvalues eigenvalues(RealRoots roots) {
  ChainEigenvalues result;
  for (const Real lambda : roots.lambda) result.omega_squared.push_back(omega_squared_at(lambda));
  result.count = std::move(roots.count);
  result.summary = std::move(roots.summary);
  return result;
}

}  // namespace

ChainEigenvalues find_chain_poles(const ArmInBeamUnits& arm, int count) {
  const auto poles_below = [&](Real lambda) { return count_at(arm, lambda).poles; };
  if (!arm.turns_freely()) {
    const CountedFunction function = {poles_below, [&](Real lambda) {
                                        const auto values = count_at(arm, lambda).values;
                                        return values.torque / values.size;
                                      }};
    auto result = eigenvalues(lowest_roots(function, below_all(function), count + 1));
    --result.count.found;
    --result.count.expected;
    return result;
  }
  // The root 0 is divided out, and the search begins between it and the first flexible one.
  const CountedFunction function = {poles_below, [&](Real lambda) {
                                      const auto values = count_at(arm, lambda).values;
                                      return -values.torque / values.size /
                                             omega_squared_at(lambda);
                                    }};
  Real low = 1.0L;
  while (function.count_below(low) > 1) low *= 0.5L;
  auto result = eigenvalues(lowest_roots(function, low, count));
  result.omega_squared.insert(result.omega_squared.begin(), 0.0L);
  return result;
}

ChainEigenvalues find_chain_hub_zeros(const ArmInBeamUnits& arm, int count) {
  const CountedFunction function = {[&](Real lambda) { return count_at(arm, lambda).hub_held; },
                                    [&](Real lambda) {
                                      const auto values = count_at(arm, lambda).values;
                                      return values.motor_angle / values.size;
                                    }};
  return eigenvalues(lowest_roots(function, below_all(function), count));
}

bool flexible_modes_are_stable(const ArmInBeamUnits& arm) {
  if (arm.gravity >= 0.0L) return true;
  // Under P > kGA the rod collapses by shear alone.
  if (1.0L + arm.shear_flexibility * arm.tension(0.0L) <= 0.0L) return false;
  return count_at(arm, 0.0L).poles <= 1;
}

}  // namespace flexarm::exact_tf
