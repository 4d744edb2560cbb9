#pragma once

#include <string>

namespace flexarm::app {

/// Throws arm::InputError where a command must not write a measurement into `folder`: something is
/// there already and `force` is not set, or what is there was not written by such a command.
void require_measurement_place(const std::string& folder, bool force);

}  // namespace flexarm::app
