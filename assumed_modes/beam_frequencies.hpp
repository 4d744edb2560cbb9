#pragma once

#include "assumed_modes/real.hpp"

#include <array>
#include <vector>

namespace flexarm::assumed_modes {

/// The two conditions at the tip of a clamped beam with payload, each divided by its own size, on
/// the functions
///
///     e^{-lambda xi} - cos + sin   and   e^{-lambda (1 - xi)} - e^{-lambda} (cos + sin),
///
/// which meet psi(0) = psi'(0) = 0. Row 0: psi'' = lambda^4 iota psi'; row 1:
/// psi''' = -lambda^4 eta psi.
using TipConditions = std::array<std::array<Real, 2>, 2>;
TipConditions tip_conditions(Real lambda, Real payload_mass_ratio, Real payload_inertia_ratio);

/// The first `count` roots lambda of cos lambda cosh lambda = -1, ascending.
std::vector<Real> clamped_free_frequencies(int count);

/// The first `count` positive roots lambda of tan lambda = tanh lambda, ascending.
std::vector<Real> pinned_free_frequencies(int count);

/// The first `count` roots of the clamped beam with tip mass eta m l and tip inertia iota m l^3.
///
/// A mass added at one coordinate lowers each frequency, not below the one before it (Rayleigh's
/// theorem of interlacing, Theory of Sound, art. 92a). Added one after the other, tip mass and tip
/// inertia thus have one root in each interval between the roots of the beam before, and none can
/// be missed.
std::vector<Real> clamped_payload_frequencies(int count, Real payload_mass_ratio,
                                              Real payload_inertia_ratio);

}  // namespace flexarm::assumed_modes
