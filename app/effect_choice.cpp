#include "app/effect_choice.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void add_effect_choice(CLI::App& parser, std::vector<std::string>& effects) {
  parser
      .add_option("--effects", effects,
                  "Effects to test, comma-separated; default: all of the library")
      ->delimiter(',')
      ->allow_extra_args(false);
}

}  // namespace flexarm::app
