#pragma once

#include "response/any_formulation.hpp"

#include <array>
#include <string_view>

namespace flexarm::response {

inline constexpr std::array<std::string_view, 3> kFormulationNames = {
    exact_tf::ExactArm::kName, fem::FemArm::kName, assumed_modes::AssumedModesArm::kName};

/// Throws InputError, which begins with `key`, unless `name` is a formulation's.
void require_formulation(std::string_view key, std::string_view name);

/// The formulation of that name for the arm's linear effects alone, at settings fine enough for
/// `roots` roots (response/settings.hpp); RigidHub for an arm without a beam, whatever the name.
/// Actuator, sensor and nonlinear effects are taken off: response/arm_parts.hpp says who honours
/// them.
///
/// Throws InputError for an unknown name, an arm that the formulation refuses, and more roots than
/// kMostRoots by a discrete formulation.
AnyFormulation make_formulation(std::string_view formulation, const arm::Arm& arm, int roots);

/// exact_tf of the arm's linear effects, in working arithmetic: for the evaluations of a fit.
/// RigidHub for an arm without a beam.
AnyFormulation formulation_of_fit(const arm::Arm& arm);

/// The same formulation at the same settings for another arm, whose linear effects alone count.
AnyFormulation with_arm(const AnyFormulation& formulation, const arm::Arm& arm);

/// The arm with nothing that dissipates linearly: no Kelvin-Voigt damping, no viscous friction, no
/// drag of air, its linear damping effects included.
arm::Arm without_damping(const arm::Arm& arm);

}  // namespace flexarm::response
