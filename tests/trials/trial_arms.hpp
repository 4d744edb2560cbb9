#pragma once

#include "arm/arm.hpp"

#include <string_view>
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

/// One of these, or "steel ruler": half a metre, 30 mm x 1 mm. Throws InputError for another name.
const TrialArm& find_trial_arm(std::string_view name);

}  // namespace flexarm::trials
