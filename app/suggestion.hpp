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

}  // namespace flexarm::app
