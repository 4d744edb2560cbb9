#pragma once

#include "arm/linear_arm.hpp"

namespace flexarm::fem {

/// Throws arm::InputError, which names effects.gravity.acceleration, for an arm that stands up and
/// of which more than the lowest mode buckles: K has two negative eigenvalues or more.
void require_unbuckled(const arm::LinearArm& arm);

/// `shift` doubled until K + shift M has no negative eigenvalue and then once more; without the
/// first `held` coordinates. The matrices are those of a few elements of high degree.
double shift_of_standing_arm(const arm::LinearArm& arm, int held, double shift);

}  // namespace flexarm::fem
