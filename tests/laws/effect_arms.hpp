#pragma once

#include "arm/arm.hpp"

#include <ostream>
#include <string>
#include <vector>

namespace flexarm::laws {

/// An arm with linear effects switched on, named after them.
struct EffectArm {
  std::string name;
  arm::Arm arm;
};

inline void PrintTo(const EffectArm& each, std::ostream* out) {
  *out << each.name;
}

/// The aluminium link with payload mass and inertia, hub friction and Kelvin-Voigt damping, that
/// the effects below extend.
arm::Arm damped_arm();

/// One arm for every linear effect of the vocabulary.
std::vector<EffectArm> arms_with_one_effect();

/// One arm for every pair of them, but for root_compliance and root_damping, which exclude each
/// other.
std::vector<EffectArm> arms_with_two_effects();

/// All at once that do not exclude each other.
EffectArm arm_with_every_effect();

/// The relative difference that two formulations of this arm may show: 1e-9, or 1e-8 with gravity
/// or shear.
double agreement_tolerance(const arm::Arm& arm);

}  // namespace flexarm::laws
