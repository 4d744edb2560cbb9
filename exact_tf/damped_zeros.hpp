#pragma once

#include "arm/formulation.hpp"

#include <optional>
#include <vector>

namespace flexarm::exact_tf {

/// Zeros of the damped transfer function from hub torque to a sensor, beside undamped ones.
struct DampedZeroSet {
  /// One an undamped zero, in their order: both roots that +-s become as all damping grows from 0
  /// to its value. Conjugates or two real ones as arm::PolePair; of a zero off both axes what s and
  /// -s become, whose conjugates are zeros too. Empty where a root could not be followed.
  std::vector<std::optional<arm::PolePair>> pairs;
  arm::SolveSummary summary;  ///< `converged` is false where a pair is empty
};

}  // namespace flexarm::exact_tf
