#pragma once

#include "arm/formulation.hpp"
#include "fem/discretisation.hpp"

namespace flexarm::fem {

/// How far the roots of the Rosenbrock pencil are believed.
struct TrustOptions {
  double eigen_tolerance = 1e-12;  ///< of the iteration for the first guesses
  double agreement = 1e-2;         ///< trusted: |s - s'| <= agreement |s'|
};

/// The `count` trusted zeros smallest in |s| of a sensor that is not collocated, dimensionless, and
/// the roots that were rejected on the way. Each root s of `model` is followed to `checking`, a
/// finer discretisation of the same arm, by Newton's method; s' is where it ends. A root is
/// rejected when it moves by more than the agreement, when it has no counterpart, or when a
/// nearer root has the same one.
arm::ZeroSet trusted_zeros(const Discretisation& model, const Discretisation& checking,
                           const arm::Arm& arm, const arm::Sensor& sensor, int count,
                           const TrustOptions& options);

}  // namespace flexarm::fem
