#pragma once

#include "arm/formulation.hpp"
#include "fem/discretisation.hpp"

namespace flexarm::fem {

/// How far the roots of the Rosenbrock pencil are believed.
struct TrustOptions {
  double eigen_tolerance = 1e-12;  ///< of the iteration for the first guesses
  double agreement = 1e-2;         ///< trusted: |s - s'| <= agreement |s'|
};

/// Two finer discretisations of the same arm, the second finer than the first.
struct CheckingModels {
  Discretisation fine;
  Discretisation finer;
};

/// The trusted zeros among the `count` + 4 smallest roots of a sensor that is not collocated, at
/// most `count`, dimensionless, and the roots that were rejected on the way.
///
/// Each root s of `model` is followed by Newton's method to s' on the fine model and from there to
/// s'' on the finer one. A zero of the arm converges; a root that is an artefact of the elements
/// has no counterpart, or lands on some other root, which then moves in its turn. So s is trusted
/// when
///
///     |s - s'| <= agreement |s'|   and   |s' - s''| <= max(|s - s'|/10, agreement |s''|/1000),
///
/// and no nearer root has the same counterpart. `count` of the result: roots found, trusted or not,
/// up to the last that was looked at, beside the number there are by the argument principle (small
/// models only).
arm::ZeroSet trusted_zeros(const Discretisation& model, const CheckingModels& checking,
                           const arm::Arm& arm, const arm::Sensor& sensor, int count,
                           const TrustOptions& options);

}  // namespace flexarm::fem
