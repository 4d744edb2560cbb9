#include "app/command.hpp"
#include "app/json_file.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/json/effects_json.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/effect_tables.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace flexarm::app {

namespace {

struct EffectsArguments {
  std::string name;
  bool markdown = false;
  bool schema = false;
  std::string json_file;
};

int run_effects(const EffectsArguments& arguments) {
  const effects::Entry* one = nullptr;
  if (!arguments.name.empty()) {
    one = effects::find(arguments.name);
    if (one == nullptr) {
      throw arm::InputError(
          fmt::format("effects {}: {}", arm::shown(arguments.name),
                      arm::unknown_effect(effects::vocabulary(), arguments.name)));
    }
  }
  if (!arguments.json_file.empty()) {
    const auto chosen = one != nullptr ? std::vector{*one} : effects::entries();
    write_json(arguments.json_file,
               report::json_document("flexarm.effects/1", report::effects_json(chosen)));
  }
  if (arguments.schema) {
    print(report::arm_file_schema(effects::entries()).dump(2) + "\n");
  } else if (arguments.markdown) {
    print(report::effects_document(effects::entries()));
  } else if (one != nullptr) {
    print(report::effect_page(*one, screen_width()));
  } else {
    print(report::effect_list(effects::entries(), screen_width()) +
          "\nnext: details of one effect with  flexarm effects coulomb_friction\n");
  }
  return kSuccess;
}

}  // namespace

Command add_effects(CLI::App& program) {
  const auto arguments = std::make_shared<EffectsArguments>();
  CLI::App* parser =
      program.add_subcommand("effects", "List the effect library, or describe one effect");
  parser->add_option("NAME", arguments->name, "Name of one effect, e.g. coulomb_friction");
  CLI::Option* markdown =
      parser->add_flag("--markdown", arguments->markdown, "Print docs/effects.md");
  parser
      ->add_flag("--schema", arguments->schema,
                 "Print a JSON Schema of the arm file, for editors that check TOML")
      ->excludes(markdown);
  parser->add_option("--json", arguments->json_file,
                     "File for the library as JSON; - for standard output");
  parser->footer(example("flexarm effects stribeck_friction"));
  return {parser, [arguments] { return run_effects(*arguments); }};
}

}  // namespace flexarm::app
