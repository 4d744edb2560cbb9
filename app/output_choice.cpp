#include "app/output_choice.hpp"

#include "app/command.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/gnuplot.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void OutputChoice::prepare() const {
  if (!folder.empty()) {
    report::run_gnuplot("");  // throws where there is none
    measured::make_folder(folder);
  }
  // The JSON may go into the folder.
  if (!json_file.empty()) measured::require_writable(json_file);
}

void add_output_choice(CLI::App& parser, OutputChoice& choice, const std::string& content) {
  parser.add_option("--out", choice.folder, content)->check(not_empty());
  parser.add_option("--json", choice.json_file, "JSON file, full precision")->check(not_empty());
}

}  // namespace flexarm::app
