#pragma once

#include "arm/payload.hpp"
#include "measured/files/toml_faults.hpp"

#include <string>

namespace flexarm::measured {

/// The table `run.payload` of a file of runs, { mass = 0.06, inertia = 0.0 }; what is wrong with it
/// goes to `faults`.
arm::Payload read_payload(measured::TomlFaults& faults, const toml::node& node);

/// The value that `read_payload` reads, with its units as a comment behind it.
std::string format_payload(const arm::Payload& payload);

}  // namespace flexarm::measured
