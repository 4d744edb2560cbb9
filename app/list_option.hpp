#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace flexarm::app {

/// Adds an option whose value is a list A,B,C of numbers or of words; it may be repeated. What is
/// typed replaces what is there. A comma that may be meant as a decimal comma is refused
/// (arm/decimal_comma.hpp).
CLI::Option* add_list_option(CLI::App& parser, const std::string& name,
                             std::vector<double>& numbers, const std::string& help);
CLI::Option* add_list_option(CLI::App& parser, const std::string& name,
                             std::vector<std::string>& words, const std::string& help);

/// Whether the value of an option is a comma-separated list: one of those above, or one with the
/// delimiter ','. All other options take one value, and may be repeated where several are allowed.
bool is_list_option(const CLI::Option& option);

}  // namespace flexarm::app
