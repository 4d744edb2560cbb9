#pragma once

#include "app/option_tree.hpp"

#include <string>
#include <vector>

namespace flexarm::app {

/// The script that completes the commands, options and values of `flexarm` in a shell. Words of a
/// list are completed one by one, after each comma.
std::string bash_completion(const CommandDescription& program,
                            const std::vector<CommandDescription>& commands);
std::string zsh_completion(const CommandDescription& program,
                           const std::vector<CommandDescription>& commands);
std::string fish_completion(const CommandDescription& program,
                            const std::vector<CommandDescription>& commands);

}  // namespace flexarm::app
