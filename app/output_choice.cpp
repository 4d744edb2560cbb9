#include "app/output_choice.hpp"

#include "app/command.hpp"
#include "arm/input_error.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void OutputChoice::prepare(const FolderKind& kind) const {
  figures.require_valid(folder);
  if (folder.empty()) {
    if (force) throw arm::InputError("--force: needs --out FOLDER");
  } else {
    require_place(folder, force, kind);
  }
  require_json_place(json_file, folder);
}

void add_output_choice(CLI::App& parser, OutputChoice& choice, const std::string& content) {
  parser.add_option("--out", choice.folder, content)->check(not_empty());
  parser.add_flag("--force", choice.force, "Overwrite a folder written by this command");
  parser.add_option("--json", choice.json_file, "JSON file, full precision; - for standard output")
      ->check(not_empty());
  add_figure_choice(parser, choice.figures);
}

}  // namespace flexarm::app
