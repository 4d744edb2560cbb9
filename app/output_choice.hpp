#pragma once

#include "app/figure_choice.hpp"
#include "app/folder_place.hpp"

#include <string>

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
  /// could not be drawn, or the JSON not be written: before the work, not after it.
  void prepare(const FolderKind& kind) const;
};

/// `--out`, `--force`, `--json` and the options of figures; `content` is what the folder is for.
void add_output_choice(CLI::App& parser, OutputChoice& choice, const std::string& content);

}  // namespace flexarm::app
