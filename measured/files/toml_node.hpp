#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace flexarm::measured {

/// What a value is, for an error about its type: "a table", "a number".
std::string_view kind_of(const toml::node& node);

/// " = VALUE" for a value that goes on a line, "" for tables and arrays.
std::string equals_value(const toml::node& node);

}  // namespace flexarm::measured
