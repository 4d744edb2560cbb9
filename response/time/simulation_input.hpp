#pragma once

#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <cstddef>
#include <span>

namespace flexarm::response {

/// Throws InputError for the first of parameters, torque samples and options that `simulate` cannot
/// take.
void require_simulable(const ArmParts& parts, std::span<const double> torque_N_m,
                       const SimulationOptions& options);

/// The same for the options alone.
void require_options(const SimulationOptions& options);

/// The same for the torque at sample `k`.
void require_command(const ArmParts& parts, double torque_N_m, std::size_t k, double sample_time_s);

}  // namespace flexarm::response
