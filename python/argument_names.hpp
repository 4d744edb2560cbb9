#pragma once

#include <string>
#include <string_view>

namespace flexarm::python {

/// The argument that stands for an option of the program (arm/option_name.hpp): "max_causes" for
/// max-causes, "time_limit_s" for time-limit. Numbers have their unit in the name.
std::string as_argument(std::string_view option);

}  // namespace flexarm::python
