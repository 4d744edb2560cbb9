#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "assumed_modes/basis.hpp"

namespace flexarm::assumed_modes {

/// What the zeros of a sensor away from the hub are computed with.
struct OutputZeroOptions {
  Basis basis = Basis::legendre;
  int functions = 36;
  double zero_change = 1e-3;  ///< as AssumedModesOptions has it
};

/// The first `count` zeros of torque to a sensor that is not at the hub, at its place on the arm.
///
/// At a zero on the real axis of s the motion dies out from the hub to the tip and its adjoint from
/// the tip to the hub, both as exp(-kappa): the eigenvalue's condition number is of this size, and
/// kappa grows with every zero, and with the root of the axial tension. In Legendre functions times
/// exp(-r xi), with test functions times exp(r xi), it is exp(|kappa - r|). So the zeros are
/// computed with r = 0, where the lowest are most accurate, and then with r = 6, 24, 42, ... until
/// the zeros are settled, each from the problem in which it changes least when functions are
/// added (TrustedZeros). Where r is large there are more functions: solutions times exp(r xi) are
/// as steep as that. Tip deflection and the other bases have r = 0 alone; at a zero of the tip
/// deflection hub and tip move both.
arm::ZeroSet output_zeros(const arm::Sensor& sensor, const arm::LinearArm& arm,
                          const OutputZeroOptions& options, int count);

}  // namespace flexarm::assumed_modes
