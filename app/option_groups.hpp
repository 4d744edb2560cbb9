#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::app {

/// The headings of a command's help, in their order.
std::vector<std::string> option_groups(std::string_view command);

/// The heading that an option ("--out") of a command stands under.
std::string group_of(std::string_view command, std::string_view option);

}  // namespace flexarm::app
