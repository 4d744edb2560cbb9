#pragma once

#include "arm/formulation.hpp"
#include "fem/discretisation.hpp"
#include "fem/pole_free_numerator.hpp"
#include "fem/transmission_zeros.hpp"

#include <cstddef>

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

/// The numerators of one sensor on three models, which must outlive the object.
struct CheckedNumerators {
  /// Takes `poles` poles out of each, found to `tolerance`.
  CheckedNumerators(const Discretisation& discretisation, const CheckingModels& checking,
                    const arm::Sensor& sensor, int poles, double tolerance);

  PoleFreeNumerator model;
  PoleFreeNumerator fine;
  PoleFreeNumerator finer;
};

/// Zeros beside where the search for them left a gap.
struct JudgedZeros {
  arm::ZeroSet zeros;        ///< dimensionless; `infinite` is not set
  std::size_t complete = 0;  ///< leading roots with none missing among or before them
  bool gap = false;          ///< a root is missing before the last that was looked at
};

/// The trusted zeros among `roots`, at most `count`, and the roots rejected on the way.
///
/// Each root s is followed by Newton's method to s' on the fine model and from there to s'' on the
/// finer one. A zero of the arm converges; a root that is an artefact of the elements has no
/// counterpart, or lands on some other root, which then moves in its turn. So s is trusted when
///
///     |s - s'| <= agreement |s'|   and   |s' - s''| <= max(|s - s'|/10, agreement |s''|/1000),
///
/// no nearer root has the same counterpart, and no root is missing before it. |s - s'|/|s'| is
/// stated as its relative change. `zeros.count`: roots found, trusted or not, up to the last that
/// was looked at, beside the number there are by the argument principle. Where that is another
/// number, `summary.converged` is false.
JudgedZeros judge(const PencilRoots& roots, const CheckedNumerators& numerators, int count,
                  double agreement);

/// The trusted zeros of a sensor that is not collocated among the `count` + 4 smallest roots of its
/// pencil, by `judge`, dimensionless. Where the count tells of a missing root, the search goes on
/// beside the first gap until it closes or nothing more is found.
arm::ZeroSet trusted_zeros(const Discretisation& model, const CheckingModels& checking,
                           const arm::Sensor& sensor, int count, const TrustOptions& options);

}  // namespace flexarm::fem
