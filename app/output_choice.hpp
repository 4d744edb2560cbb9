#pragma once

#include "app/figure_choice.hpp"
#include "app/folder_place.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Where a command writes besides standard output; empty: nowhere.
struct OutputChoice {
  std::string folder;
  bool force = false;
  std::string json_file;  ///< "-": standard output (app/json_file.hpp)
  FigureChoice figures;

  /// Throws arm::InputError where the folder must not be written (`require_place`), its figures
  /// could not be drawn, the JSON not be written, or either would take the place of one of
  /// `inputs`, which the command line does not name (app/kept_inputs.hpp has those that it does):
  /// before the work, not after it.
  void prepare(const FolderKind& kind, const std::vector<std::filesystem::path>& inputs = {}) const;
};

/// What the help says of a command's outputs.
struct OutputHelp {
  std::string folder;
  std::string force = "Overwrite a folder written by this command";
  std::string json_file = "JSON file, full precision; - for standard output";
};

/// `--out`, `--force`, `--json` and the options of figures.
void add_output_choice(CLI::App& parser, OutputChoice& choice, const OutputHelp& help);

}  // namespace flexarm::app
