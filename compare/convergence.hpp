#pragma once

#include <limits>
#include <optional>
#include <span>

namespace flexarm::compare {

/// One setting of a refinement series and the error it leaves.
struct RefinementPoint {
  int setting = 0;  ///< number of elements, degree or number of functions
  int degrees_of_freedom = 0;
  double relative_error = 0.0;  ///< against the exact root; NaN when the setting has no such root
};

/// How an error falls under refinement.
enum class Decay {
  algebraic,    ///< error ~ setting^-order
  exponential,  ///< error ~ 10^(-rate degrees of freedom)
};

/// What a series of refinements shows.
struct Convergence {
  /// Algebraic: the order p of error ~ setting^-p. Exponential: decades gained per degree of
  /// freedom. Least squares over the points that lie between kPreAsymptotic and the rounding floor;
  /// empty with fewer than `kFewestPoints` of them, and where they do not fall along a line.
  std::optional<double> rate;
  int points_fitted = 0;
  double smallest_error = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no setting has one
  /// The setting from which refinement no longer lowers the error: rounding has taken over. Empty
  /// when the series ends before that.
  std::optional<RefinementPoint> rounding_onset;
  /// The setting with the fewest degrees of freedom from which on the error stays at or below the
  /// wanted accuracy. Empty when the series does not get there.
  std::optional<RefinementPoint> cheapest;
};

/// Errors above this are not yet in the asymptotic range.
inline constexpr double kPreAsymptotic = 1e-2;
/// Two points fix a slope; the third tests it.
inline constexpr int kFewestPoints = 3;
/// Algebraic orders are read off the finest points above the floor: those whose setting is at most
/// this factor below the finest.
inline constexpr int kWidestRange = 8;

/// Reads order, floor and cheapest setting off a series ordered by setting.
Convergence observe_convergence(std::span<const RefinementPoint> series, Decay decay,
                                double wanted_accuracy);

}  // namespace flexarm::compare
