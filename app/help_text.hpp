#pragma once

#include <memory>

namespace CLI {
class FormatterBase;
}  // namespace CLI

namespace flexarm::app {

/// What `--help` prints: summary, usage, arguments, options in groups with values, units and
/// defaults, exit status and example; as wide as standard output, at most 80 columns.
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace flexarm::app
