#include "app/command.hpp"
#include "app/folder_place.hpp"
#include "app/json_file.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "compare/paper/paper_topics.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/text_file.hpp"
#include "report/json/paper_json.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/paper_markdown.hpp"
#include "report/tables/paper_tables.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

struct PaperArguments {
  std::string part;
  std::string json;
  std::string out;
  bool force = false;
  std::string document;
  bool verbose = false;
};

std::vector<measured::NamedContent> files_of(const compare::paper::Findings& findings) {
  return {{"comparisons.csv", report::to_csv(report::paper_listing(findings))},
          {"cells.csv", report::to_csv(report::paper_cells(findings))},
          {"paper.json", report::paper_json(findings)},
          {"paper.txt", report::paper_text(findings, "")}};
}

void update_document(const std::string& path, const compare::paper::Findings& findings) {
  constexpr std::size_t kLargest_bytes = std::size_t{1} << 24U;
  const std::string document = measured::read_text_file(path, kLargest_bytes);
  try {
    measured::write_atomically(path, report::updated_paper_document(document, findings));
  } catch (const arm::InputError& error) {
    throw arm::located(error, path, 0);
  }
}

/// The verdicts: what of the paper holds.
std::string overview_text(const compare::paper::Findings& findings) {
  return screen_paragraph(report::paper_verdict_line(findings)) + "\n" +
         screen_table(report::paper_overview(findings)) +
         screen_paragraph(report::paper_cells_line(findings)) +
         details_line(false, "each check with its finding and values");
}

int run_paper(const PaperArguments& arguments) {
  if (!arguments.out.empty()) {
    require_place(arguments.out, arguments.force,
                  {"the check of the paper", {"paper.json"}, {".csv", ".json", ".txt"}});
  } else if (arguments.force) {
    throw arm::InputError("--force: needs --out FOLDER");
  }
  require_json_place(arguments.json, arguments.out);
  const auto findings = compare::paper::check_paper();
  const bool is_whole = arguments.part.empty() && !arguments.verbose;
  const std::string text =
      is_whole ? overview_text(findings) : report::paper_text(findings, arguments.part);
  if (text.empty()) {
    throw arm::InputError(fmt::format(
        "no part \"{}\": give an equation number (22) or a word of a heading (\"Table 6\")",
        arguments.part));
  }
  if (!arguments.out.empty()) write_folder(arguments.out, arguments.force, files_of(findings));
  write_json(arguments.json, report::paper_json(findings));
  if (!arguments.document.empty()) update_document(arguments.document, findings);
  print(text);
  for (const auto& written : {arguments.json, arguments.out, arguments.document}) {
    if (!written.empty()) print(fmt::format("wrote {}\n", written));
  }
  print(arguments.part.empty()
            ? "next: one equation with  flexarm paper 22\n"
            : "next: compare the three formulations for this arm with  flexarm compare\n");
  return kSuccess;
}

}  // namespace

Command add_paper(CLI::App& program) {
  const auto arguments = std::make_shared<PaperArguments>();
  CLI::App* parser = program.add_subcommand(
      "paper", "Check each equation and table of the paper against the three formulations");
  parser->add_option("PART", arguments->part,
                     "Only this part: equation number, or words such as \"Table 6\"");
  add_verbose(*parser, arguments->verbose, "Print every check with its finding and values");
  parser->add_option("--json", arguments->json, "JSON file with all values; - for standard output")
      ->check(not_empty());
  parser->add_option("--out", arguments->out, "Write text, CSV and JSON to this folder")
      ->check(not_empty());
  parser->add_flag("--force", arguments->force, "Overwrite a folder written by this command");
  parser->add_option("--update", arguments->document,
                     "Update the marked blocks of this document (docs/paper.md)");
  parser->footer(example("flexarm paper 22"));
  return {parser, [arguments] { return run_paper(*arguments); }};
}

}  // namespace flexarm::app
