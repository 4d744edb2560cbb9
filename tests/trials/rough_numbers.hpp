#pragma once

#include "arm/arm.hpp"
#include "tests/trials/random.hpp"

#include <map>
#include <string>

namespace flexarm::trials {

/// Multiplies rigidity, linear density and hub inertia by exp(size u n), n normal and u their
/// uncertainty, drawn from 3 to 10 %. Returns the uncertainties by the keys of the arm file; none
/// at size 0.
std::map<std::string, double> make_rough(arm::Arm& arm, double size, Random& random);

}  // namespace flexarm::trials
