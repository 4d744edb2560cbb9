#pragma once

#include "arm/arm.hpp"

#include <string_view>

namespace flexarm::arm {

/// Whether the arm has a beam. One without is a rigid hub: its file has no [beam],
///
///     Ih theta_tt + c theta_t = tau,
///
/// and effects on the hub, on the torque's path and on the hub's sensors.
bool has_beam(const Arm& arm);

/// "WHAT: needs a beam; the arm file has no [beam]", for an arm without.
void require_beam(const Arm& arm, std::string_view what);

/// Whether the effect acts on a rigid hub too: on the hub's numbers, spring and dashpot, on the
/// torque, or on a sensor. The others act on a beam or its payload and are refused without one.
bool acts_without_beam(const EffectDefinition& definition);

/// What `require_valid(arm)` requires of an arm without a beam: an inertia above 0, no payload, no
/// damping of a material, and effects that act without a beam.
void require_valid_rigid_hub(const Arm& arm);

}  // namespace flexarm::arm
