#pragma once

#include "arm/arm.hpp"

#include <vector>

namespace flexarm::trials {

/// An arm, and the torque that turns it by angles as in a laboratory.
struct TrialArm {
  arm::Arm arm;
  double low_torque_N_m;  ///< root mean square of the weakest excitation
};

/// The paper's aluminium link; a steel one on a heavy hub; a short one of a sandwich that is soft
/// in shear, the only one in which shear shows below half the sampling frequency.
const std::vector<TrialArm>& trial_arms();

}  // namespace flexarm::trials
