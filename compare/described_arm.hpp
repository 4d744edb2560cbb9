#pragma once

#include "arm/arm.hpp"
#include "measured/checks/described_arm.hpp"
#include "measured/checks/run_check.hpp"

namespace flexarm::compare {

/// The readings of an arm with its linear effects alone, by simulation of its fem model: what the
/// data checks compare a record with (measured::DataCheckOptions::described). Friction and the
/// other laws are left out: the checks ask for what holds with and without them.
///
/// Throws InputError for an arm that `fem` refuses.
measured::DescribedArm described_arm(const arm::Arm& arm);

/// What the data checks may know of the arm with any payload: length, inertia and readings. The
/// last are left out where `fem` refuses the arm.
measured::DescribedArms described_arms(const arm::Arm& arm);

}  // namespace flexarm::compare
