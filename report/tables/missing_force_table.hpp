#pragma once

#include "diagnose/unknown/missing_force.hpp"
#include "report/tables/table.hpp"

#include <string>

namespace flexarm::report {

/// "sensor hub_angle, hub_velocity", "root".
std::string port_name(const diagnose::PortShare& port);

/// At which port the missing force acts, what it explains and how large it is; or that this is not
/// determined, and why.
std::string missing_force_text(const diagnose::MissingForce& force);

/// A row a port: what a force there explains, with its standard error.
Table missing_force_table(const diagnose::MissingForce& force);

}  // namespace flexarm::report
