#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Where a command writes besides standard output; empty: nowhere.
struct OutputChoice {
  std::string folder;
  std::string json_file;

  /// Makes the folder. Throws arm::InputError where the JSON could not be written, or the folder's
  /// figures not be drawn: before the work, not after it.
  void prepare() const;
};

/// `--out` and `--json`; `content` is what the folder is for.
void add_output_choice(CLI::App& parser, OutputChoice& choice, const std::string& content);

}  // namespace flexarm::app
