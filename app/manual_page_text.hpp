#pragma once

#include "app/option_tree.hpp"

#include <string>
#include <vector>

namespace flexarm::app {

/// The manual page flexarm(1), in the macros of man(7).
std::string manual_page(const CommandDescription& program,
                        const std::vector<CommandDescription>& commands);

/// The manual page flexarm-COMMAND(1).
std::string manual_page(const CommandDescription& command);

}  // namespace flexarm::app
