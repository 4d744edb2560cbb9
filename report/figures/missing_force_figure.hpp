#pragma once

#include "diagnose/unknown/missing_force.hpp"
#include "report/figures/figure.hpp"

namespace flexarm::report {

/// Above, where the size of the force is known, its spectrum: RMS values in third octaves, with two
/// standard errors. Below what a force at each port explains, likewise, the ports that are stated
/// apart from the others. `force` has ports.
Figure missing_force_figure(const diagnose::MissingForce& force);

}  // namespace flexarm::report
