#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace flexarm::app {

/// The one line for a command line that `program` refused with `error`: what is wrong, the
/// subcommand or option that was probably meant, and where the help is.
std::string explain(const CLI::App& program, const CLI::ParseError& error);

/// The unit of an option's numbers, as its name ("--to-Hz") or its help tells: "s" of "Sampling
/// period [s]; default: ..."; empty for none.
std::string unit_of_option(const std::string& name, const std::string& help);

}  // namespace flexarm::app
