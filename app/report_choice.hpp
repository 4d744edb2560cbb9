#pragma once

#include "report/page/page_document.hpp"
#include "report/page/page_origin.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// `--report FILE.html`: one page with the results; empty: none.
struct ReportChoice {
  std::string file;

  bool is_given() const { return !file.empty(); }

  /// Throws arm::InputError for a report that could not be written, or would take the place of one
  /// of `inputs`, which the command line does not name (app/kept_inputs.hpp has those that it
  /// does): before the work, not after it. It may go into `folder`, that of `--out`, which need not
  /// be there yet.
  void prepare(const std::string& folder,
               const std::vector<std::filesystem::path>& inputs = {}) const;

  /// Writes the page whole or not at all. Throws arm::InputError where it cannot be written.
  void write(report::page::PageDocument document) const;

  /// The last line of a command's output, "wrote FILE.html\n"; empty without a report.
  std::string last_line() const;
};

void add_report_choice(CLI::App& parser, ReportChoice& choice);

/// What a page says of its origin; `subject` as in PageOrigin.
report::page::PageOrigin page_origin(const std::string& subject);

/// Notes the command line, for the pages.
void note_command_line(int argc, const char* const* argv);

}  // namespace flexarm::app
