#pragma once

#include "arm/input_error.hpp"
#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace flexarm::response {

/// Throws InputError for the first of parameters, torque samples and options that `simulate` cannot
/// take.
void require_simulable(const ArmParts& parts, std::span<const double> torque_N_m,
                       const SimulationOptions& options);

/// The same for the options alone.
void require_options(const SimulationOptions& options);

/// The same for the torque at sample `k`.
void require_command(const ArmParts& parts, double torque_N_m, std::size_t k, double sample_time_s);

/// What a run that has grown too large for a number throws, `what` of it at that time.
arm::InputError too_large(const std::string& what, double time_s);

}  // namespace flexarm::response
