#pragma once

#include "arm/input_error.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// The error as the command line has it. A library names a number or a word by its key:
/// "poles = 0: must be 1 or more" becomes "--poles = 0: must be 1 or more" where that option was
/// given. What is within the value of an option gets the option in front:
/// "random.rms = -1 N m: ..." becomes "--excitation random.rms = -1 N m: ...".
/// A line that begins with anything else, such as "rig.toml:8: ", stays as it is.
arm::InputError placed(const arm::InputError& error, const CLI::App& command);

}  // namespace flexarm::app
