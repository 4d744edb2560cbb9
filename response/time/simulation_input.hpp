#pragma once

#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <span>

namespace flexarm::response {

/// Throws InputError for the first of parameters, torque samples and options that `simulate` cannot
/// take.
void require_simulable(const ArmParts& parts, std::span<const double> torque_N_m,
                       const SimulationOptions& options);

}  // namespace flexarm::response
