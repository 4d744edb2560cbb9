#pragma once

#include "arm/arm.hpp"
#include "measured/checks/described_arm.hpp"
#include "measured/checks/run_check.hpp"

#include <span>

namespace flexarm::compare {

/// The readings of an arm with its linear effects alone, by simulation of its fem model: what the
/// data checks compare a record with (measured::DataCheckOptions::described). Friction and the
/// other laws are left out: the checks ask for what holds with and without them.
///
/// Throws InputError for an arm that `fem` refuses.
measured::DescribedArm described_arm(const arm::Arm& arm);

/// The arm with an effect of the library more, or with an arm number changed by one, of the sizes
/// that a diagnosis looks for. Effects on the path of the torque or of a sensor are left out: they
/// are what a data check calls a fault. Laws of the hub and forces along the beam act here.
measured::ArmVariations arm_variations(const arm::Arm& arm, std::span<const double> torque_N_m,
                                       double period_s);

/// What the data checks may know of the arm with any payload: length, inertia, readings and
/// variations. The last two are left out where `fem` refuses the arm.
measured::DescribedArms described_arms(const arm::Arm& arm);

}  // namespace flexarm::compare
