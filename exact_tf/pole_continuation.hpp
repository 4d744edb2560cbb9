#pragma once

#include "arm/formulation.hpp"
#include "exact_tf/scaled.hpp"

#include <functional>
#include <vector>

namespace flexarm::exact_tf {

/// A characteristic function F(s; d) of the arm with all its damping times d, analytic in both; s
/// in rad/s. An arm that turns freely has the root s = 0 at every d, which is divided out of F.
/// Where F has no value it is not finite.
using DampedCharacteristic =
    std::function<Scaled<Complex>(const Complex& s_rad_per_s, const Complex& damping)>;

/// Where the pair of roots of one mode starts, and how damping other than Kelvin-Voigt's moves it.
struct UndampedMode {
  Real omega_squared_rad2_per_s2 = 0.0L;  ///< of either sign; 0 where nothing holds the arm
  Real damping_rad_per_s = 0.0L;          ///< D_ii of arm::ModalModel less kv omega^2
};

struct ContinuationOptions {
  /// With rho = |F'/F''| in terms of u below, at most some half of the distance to the nearest
  /// other root: a step in d is taken as far as it moves u by <= this rho (more along a straight
  /// path)
  Real largest_move = 4.0L;
  /// and Newton's method ends <= this rho, there and before the step, from where the step led.
  Real largest_correction = 0.15L;
  /// Newton's method has converged once |step| <= this |u|, or no longer falls.
  Real newton_tolerance = 1e-18L;
  /// d = t + i detour t (1 - t), t from 0 to 1, for roots that meet on the way.
  Real detour = 0.2L;
  /// A path is given up after this many values of F.
  int most_function_values = 20'000;
};

/// The roots that the pairs +-i omega of `modes` become as d grows from 0 to 1: the lowest mode
/// first, then the flexible ones.
///
/// The variable that is followed is u in
///
///     s^2 + kv d u^2 s + u^2 = 0,   s = -kv d u^2/2 +- i u sqrt(1 - (kv d u/2)^2):
///
/// it rests at omega for a beam that Kelvin-Voigt damping alone acts on, however overdamped, and
/// moves with hub friction, drag of the air and springs without loss. Each u is followed along real
/// d by its tangent and Newton's method. Where roots meet (two conjugates on the real axis as a
/// mode becomes overdamped) the path leaves the real d around that point; real roots that have
/// changed partners on the way are paired anew in order. Roots that come out twice are followed
/// again with smaller steps. Residual of the summary: the last step of Newton's method over |u|.
/// `converged` is false where a path could not be followed or a root comes twice.
arm::DampedPoleSet follow_damping(const DampedCharacteristic& characteristic, Real kelvin_voigt_s,
                                  const std::vector<UndampedMode>& modes,
                                  const ContinuationOptions& options = {});

}  // namespace flexarm::exact_tf
