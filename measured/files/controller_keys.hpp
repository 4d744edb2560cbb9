#pragma once

#include "arm/controller.hpp"
#include "measured/files/toml_faults.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// The value of `controller` in a measurement file (docs/formats.md): a table with `sensor` (the
/// hub angle where it is not given) and either kp, kd, ki, derivative or A, B, C, D, and perhaps
/// limit and sample_time. What is wrong with it becomes a fault, under keys that begin with
/// `prefix`, "run.controller.".
arm::Controller read_controller(TomlFaults& faults, const std::string& prefix,
                                const toml::node& node);

/// The same table as a file of its own: its keys at the top level. Throws InputError
/// `FILE:LINE: ...`.
arm::Controller read_controller_file(const std::filesystem::path& path);

/// The same keys on one line, "kp=2.5,kd=0.1,limit=0.4": KEY=VALUE, separated by commas, without
/// quotes and without matrices. Throws InputError `WHERE: ...`.
arm::Controller parse_controller_keys(std::string_view text, const std::string& where);

/// The controller as an inline table, which `read_controller` reads back.
std::string format_controller(const arm::Controller& controller);

}  // namespace flexarm::measured
