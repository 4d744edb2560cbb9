#include "assumed_modes/beam_frequencies.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>

namespace flexarm::assumed_modes {

namespace {

constexpr Real kPi = boost::math::constants::pi<Real>();

/// The one root of `f` in [lower, upper], where it changes sign.
template <class F>
Real root_between(const F& f, Real lower, Real upper) {
  std::uintmax_t calls = 200;  // bisection alone would need 64 + log2(upper)
  const auto [left, right] = boost::math::tools::toms748_solve(
      f, lower, upper, boost::math::tools::eps_tolerance<Real>(), calls);
  return (left + right) / 2;
}

/// The roots of a beam to which inertia is added at the tip, one between consecutive members of 0
/// and the `frequencies` before. The determinant `f` is positive at 0 and alternates in sign from
/// one frequency to the next; where rounding hides its sign there, that root has not moved.
template <class F>
std::vector<Real> interlaced_roots(const F& f, const std::vector<Real>& frequencies) {
  // Steps off a root before that has not moved and would hide the sign at the lower end.
  constexpr Real kStepOff = 1e-3L;
  std::vector<Real> roots;
  Real lower = 0;
  Real sign = 1;
  for (const Real upper : frequencies) {
    if (sign * f(upper) >= 0) {
      roots.push_back(upper);
    } else {
      const bool hidden = sign * f(lower) <= 0;
      roots.push_back(root_between(f, hidden ? lower + kStepOff * (upper - lower) : lower, upper));
    }
    lower = upper;
    sign = -sign;
  }
  return roots;
}

}  // namespace

TipConditions tip_conditions(Real lambda, Real payload_mass_ratio, Real payload_inertia_ratio) {
  const Real c = std::cos(lambda);
  const Real s = std::sin(lambda);
  const Real decay = std::exp(-lambda);
  const Real mass = lambda * payload_mass_ratio;
  const Real inertia = lambda * lambda * lambda * payload_inertia_ratio;
  TipConditions rows;
  rows[0] = {decay + c - s - inertia * (c + s - decay),
             1 + decay * (c + s) - inertia * (1 + decay * (s - c))};
  rows[1] = {-decay - s - c + mass * (decay - c + s),
             1 + decay * (c - s) + mass * (1 - decay * (c + s))};
  for (Real& entry : rows[0]) entry /= 1 + inertia;
  for (Real& entry : rows[1]) entry /= 1 + mass;
  return rows;
}

std::vector<Real> clamped_free_frequencies(int count) {
  // cos cosh + 1 over cosh; at multiples of pi it alternates in sign and is never zero.
  const auto f = [](Real lambda) { return std::cos(lambda) + 1 / std::cosh(lambda); };
  std::vector<Real> roots;
  for (int i = 1; i <= count; ++i) {
    roots.push_back(root_between(f, static_cast<Real>(i - 1) * kPi, static_cast<Real>(i) * kPi));
  }
  return roots;
}

std::vector<Real> pinned_free_frequencies(int count) {
  const auto f = [](Real lambda) {
    return std::sin(lambda) - std::tanh(lambda) * std::cos(lambda);
  };
  std::vector<Real> roots;
  for (int i = 1; i <= count; ++i) {
    const Real lower = static_cast<Real>(i) * kPi;
    roots.push_back(root_between(f, lower, lower + kPi / 2));
  }
  return roots;
}

std::vector<Real> clamped_payload_frequencies(int count, Real payload_mass_ratio,
                                              Real payload_inertia_ratio) {
  const auto determinant = [](Real lambda, Real eta, Real iota) {
    const auto rows = tip_conditions(lambda, eta, iota);
    return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
  };
  std::vector<Real> roots = clamped_free_frequencies(count);
  if (payload_mass_ratio > 0) {
    roots = interlaced_roots(
        [&](Real lambda) { return determinant(lambda, payload_mass_ratio, 0); }, roots);
  }
  if (payload_inertia_ratio > 0) {
    roots = interlaced_roots(
        [&](Real lambda) { return determinant(lambda, payload_mass_ratio, payload_inertia_ratio); },
        roots);
  }
  return roots;
}

}  // namespace flexarm::assumed_modes
