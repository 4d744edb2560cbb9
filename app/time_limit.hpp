#pragma once

#include <optional>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Adds `--time-limit` to a command, whose work arm::deadline_of ends.
void add_time_limit(CLI::App& parser, std::optional<double>& limit_s);

}  // namespace flexarm::app
