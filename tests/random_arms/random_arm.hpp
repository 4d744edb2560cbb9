#pragma once

#include "arm/arm.hpp"

#include <cstdint>

namespace flexarm::random_arms {

/// Each number of an arm is between 10^-3 and 10^3 times its usual size, log-uniform.
inline constexpr double kDecades = 6.0;

/// Linear effects of an arm: up to this many, as many of each number of them.
inline constexpr int kMostEffects = 4;

/// Arm `index` of a sequence; it depends on seed and index alone.
///
/// Length, width, thickness, density, moduli, hub inertia, payload mass and inertia, Kelvin-Voigt
/// damping, hub friction and every parameter of an effect are log-uniform over `kDecades` about the
/// paper's arm and the examples of the effects. Payload mass and inertia, damping and friction are
/// absent from every other arm. Gravity and payload offset have either sign. A place on the beam is
/// at a distance from root or tip that is log-uniform over `kDecades` up to the length; a part of
/// the hub likewise up to all of it. Effects are those through the linear arm's ports that act on
/// no sensor, none twice.
///
/// The arm is valid in each number by itself; formulations may refuse the numbers together.
arm::Arm random_arm(std::uint64_t seed, std::uint64_t index);

}  // namespace flexarm::random_arms
