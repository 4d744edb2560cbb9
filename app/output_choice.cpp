#include "app/output_choice.hpp"

#include "app/command.hpp"
#include "app/kept_inputs.hpp"
#include "arm/input_error.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void OutputChoice::prepare(const FolderKind& kind,
                           const std::vector<std::filesystem::path>& inputs) const {
  if (!json_file.empty()) require_no_input("--json", json_file, inputs);
  if (!folder.empty()) require_no_input("--out", folder, inputs);
  figures.require_valid(folder);
  if (folder.empty()) {
    if (force) throw arm::InputError("--force: needs --out FOLDER");
  } else {
    require_place(folder, force, kind);
  }
  require_json_place(json_file, folder);
}

void add_output_choice(CLI::App& parser, OutputChoice& choice, const OutputHelp& help) {
  parser.add_option("--out", choice.folder, help.folder)->check(not_empty());
  parser.add_flag("--force", choice.force, help.force);
  parser.add_option("--json", choice.json_file, help.json_file)->check(not_empty());
  add_figure_choice(parser, choice.figures);
}

}  // namespace flexarm::app
