#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// What a value is, for an error about its type: "a table", "a number".
std::string_view kind_of(const toml::node& node);

/// " = VALUE" for a value that goes on a line, "" for tables and arrays.
std::string equals_value(const toml::node& node);

/// The value of a number; empty for what is none. A whole number beyond 2^53 is rounded to the next
/// double: toml++'s value<double>() has none for it.
std::optional<double> number_of(const toml::node& node);

}  // namespace flexarm::measured
