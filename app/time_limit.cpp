#include "app/time_limit.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void add_time_limit(CLI::App& parser, std::optional<double>& limit_s) {
  parser.add_option("--time-limit", limit_s,
                    "Seconds after which the command ends with what it has");
}

}  // namespace flexarm::app
