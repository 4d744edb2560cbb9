#include "assumed_modes/beam_frequencies.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace flexarm::assumed_modes {

namespace {

constexpr Real kPi = boost::math::constants::pi<Real>();

/// The one root of `f` in [lower, upper]. Where rounding hides the change of sign, the root lies
/// at an end within rounding, and that end is returned.
template <class F>
Real root_between(const F& f, Real lower, Real upper) {
  const Real at_lower = f(lower);
  const Real at_upper = f(upper);
  if (at_lower == 0 || at_upper == 0 || std::signbit(at_lower) == std::signbit(at_upper)) {
    return std::abs(at_lower) < std::abs(at_upper) ? lower : upper;
  }
  // Each step of TOMS 748 gains digits; bisection alone would need 64 + log2(pi).
  constexpr std::uintmax_t kMaximumCalls = 200;
  std::uintmax_t calls = kMaximumCalls;
  const auto [left, right] = boost::math::tools::toms748_solve(
      f, lower, upper, at_lower, at_upper, boost::math::tools::eps_tolerance<Real>(), calls);
  if (calls >= kMaximumCalls) throw std::runtime_error("frequency of a beam shape: no convergence");
  return (left + right) / 2;
}

/// One root between consecutive members of 0, frequencies[0], frequencies[1], ...
template <class F>
std::vector<Real> interlaced_roots(const F& f, const std::vector<Real>& frequencies) {
  std::vector<Real> roots;
  Real lower = 0;
  for (const Real upper : frequencies) {
    roots.push_back(root_between(f, lower, upper));
    lower = upper;
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
