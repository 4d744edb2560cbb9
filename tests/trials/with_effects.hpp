#pragma once

#include "tests/trials/world.hpp"

namespace flexarm::trials {

/// The world as the product describes it: the arm with effects of the same names, parameters and
/// sensors as the hidden causes. Throws arm::InputError for a cause that the product has no name
/// for.
arm::Arm with_effects(const World& world);

}  // namespace flexarm::trials
