#pragma once

#include <string>

namespace flexarm::app {

/// Throws arm::InputError "OPTION = COUNT: ..." where so much memory, in bytes, is more than the
/// machine or a limit of the process has: before the work. `bytes` is a lower estimate, so that
/// nothing is refused that would fit.
void require_memory(const std::string& option, double count, double bytes);

}  // namespace flexarm::app
