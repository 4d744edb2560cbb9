#pragma once

#include "exact_tf/pole_continuation.hpp"

#include <optional>

namespace flexarm::exact_tf {

/// A root of F at some d.
struct FollowedRoot {
  Complex u;
  Complex s;             ///< [rad/s]
  Real radius = 0.0L;    ///< |F'/F''| with respect to u
  Real residual = 0.0L;  ///< last step of Newton's method over |u|
};

/// Where a root starts, with du/dd there and half the distance to the nearest other.
struct PathStart {
  Complex u;
  Complex slope;
  Real radius = 0.0L;
  int branch = 1;  ///< of s = -kv d u^2/2 + branch i u q
};

/// One root of F(s; d) followed as d grows, in the variable u of exact_tf/pole_continuation.hpp.
class PolePath {
 public:
  PolePath(const DampedCharacteristic& characteristic, Real kelvin_voigt_s,
           const ContinuationOptions& options, Real detour, Real caution)
      : characteristic_(characteristic),
        kelvin_voigt_s_(kelvin_voigt_s),
        options_(options),
        detour_(detour),
        caution_(caution) {}

  /// The root at d = 1; empty where the path could not be followed.
  std::optional<FollowedRoot> follow(const PathStart& start);
  int function_values() const { return values_; }

 private:
  Complex damping_at(Real t) const { return {t, detour_ * t * (1.0L - t)}; }
  /// q = sqrt(1 - (kv d u/2)^2), continued from the last place accepted.
  Complex root_of_pair(const Complex& u, Real t) const;
  Complex s_of(const Complex& u, Real t) const;
  Scaled<Complex> value(const Complex& u, Real t) {
    ++values_;
    return characteristic_(s_of(u, t), damping_at(t));
  }
  struct Local;
  Local local(const Complex& u, Real t, Real radius);
  Complex velocity(const FollowedRoot& root, Real t, Real step);
  std::optional<FollowedRoot> newton(const Complex& from, Real t, Real radius);

  const DampedCharacteristic& characteristic_;
  Real kelvin_voigt_s_;
  const ContinuationOptions& options_;
  Real detour_;
  Real caution_;  ///< divides the lengths of steps
  int branch_ = 1;
  Complex last_q_ = 1.0L;
  int values_ = 0;
};

}  // namespace flexarm::exact_tf
