#include "exact_tf/chain_eigenvalues.hpp"

#include "exact_tf/boundary_values.hpp"
#include "exact_tf/bracketed_roots.hpp"
#include "exact_tf/chain_count.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::exact_tf {

namespace {

/// omega^2 by the variable of the search, which is lambda where omega^2 > 0.
Real omega_squared_at(Real lambda) {
  const Real square = lambda * lambda;
  return std::copysign(square * square, lambda);
}

template <class R>
TransferChain<R> chain_at(const ArmInBeamUnits<R>& arm, Real lambda) {
  return {arm, undamped_at<R>(arm, static_cast<R>(omega_squared_at(lambda)))};
}

/// Brackets end where rounding of the values does not yet decide.
template <class R>
RootSearchOptions search_options() {
  RootSearchOptions options;
  options.significand_bits = std::numeric_limits<R>::digits - 3;
  return options;
}

/// The `count` lowest roots above `low`.
RealRoots lowest_roots(const CountedFunction& function, Real low, int count,
                       const RootSearchOptions& options) {
  CountedInterval interval{low, function.count_below(low), 0.0L, 0};
  for (interval.high = (static_cast<Real>(count) + 2.0L) * std::numbers::pi_v<Real>;
       (interval.below_high = function.count_below(interval.high)) - interval.below_low < count;) {
    interval.high *= 1.5L;
  }
  return find_bracketed_roots(function, interval, count, options);
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

template <class R>
ChainEigenvalues find_chain_poles(const ArmInBeamUnits<R>& arm, int count) {
  const RootSearchOptions options = search_options<R>();
  const auto poles_below = [&](Real lambda) { return count_below(chain_at(arm, lambda)).poles; };
  if (!arm.turns_freely()) {
    const CountedFunction function = {poles_below, [&](Real lambda) -> Real {
                                        const auto values = root_values(chain_at(arm, lambda));
                                        return values.torque / values.size;
                                      }};
    auto result = eigenvalues(lowest_roots(function, below_all(function), count + 1, options));
    --result.count.found;
    --result.count.expected;
    return result;
  }
  // The root 0 is divided out, and the search begins between it and the first flexible one.
  const CountedFunction function = {poles_below, [&](Real lambda) -> Real {
                                      const auto values = root_values(chain_at(arm, lambda));
                                      return -values.torque / values.size /
                                             omega_squared_at(lambda);
                                    }};
  Real low = 1.0L;
  while (function.count_below(low) > 1) low *= 0.5L;
  auto result = eigenvalues(lowest_roots(function, low, count, options));
  result.omega_squared.insert(result.omega_squared.begin(), 0.0L);
  return result;
}

template <class R>
ChainEigenvalues find_chain_hub_zeros(const ArmInBeamUnits<R>& arm, int count) {
  const CountedFunction function = {
      [&](Real lambda) { return count_below(chain_at(arm, lambda)).hub_held; },
      [&](Real lambda) -> Real {
        const auto values = root_values(chain_at(arm, lambda));
        return values.motor_angle / values.size;
      }};
  return eigenvalues(lowest_roots(function, below_all(function), count, search_options<R>()));
}

bool flexible_modes_are_stable(const ArmInBeamUnits<Real>& arm) {
  if (arm.gravity >= 0.0L) return true;
  // Under P > kGA the rod collapses by shear alone.
  if (1.0L + arm.shear_flexibility * arm.tension(0.0L) <= 0.0L) return false;
  return count_below(chain_at(arm, 0.0L)).poles <= 1;
}

template ChainEigenvalues find_chain_poles(const ArmInBeamUnits<Real>&, int);
template ChainEigenvalues find_chain_poles(const ArmInBeamUnits<double>&, int);
template ChainEigenvalues find_chain_hub_zeros(const ArmInBeamUnits<Real>&, int);
template ChainEigenvalues find_chain_hub_zeros(const ArmInBeamUnits<double>&, int);

}  // namespace flexarm::exact_tf
