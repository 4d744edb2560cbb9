#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/json_file.hpp"
#include "app/list_option.hpp"
#include "app/output_choice.hpp"
#include "app/standard_output.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/comparison.hpp"
#include "compare/measured.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/modal_table.hpp"
#include "report/figures/comparison_plots.hpp"
#include "report/json/comparison_json.hpp"
#include "report/progress.hpp"
#include "report/tables/comparison_tables.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/text_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

struct CompareArguments {
  ArmChoice arm;
  std::string measured_file;
  std::vector<std::string> sensors;
  compare::Options options;
  bool quick = false;
  bool full = false;
  OutputChoice output;
};

compare::Options options_of(const CompareArguments& arguments,
                            const measured::ModalTable& measured) {
  compare::Options options = arguments.options;
  options.refinements = !arguments.quick;
  const auto add = [&](const arm::Sensor& sensor) {
    if (std::ranges::find(options.sensors, sensor) == options.sensors.end()) {
      options.sensors.push_back(sensor);
    }
  };
  for (const auto& name : arguments.sensors) add(arm::parse_sensor(name));
  for (const auto& sensor : compare::sensors_with_zeros(measured)) add(sensor);
  return options;
}

compare::Comparison compare_with_progress(const arm::Arm& arm, compare::Options options) {
  std::unique_ptr<report::Progress> progress;
  options.progress = [&progress](int, int total) {
    if (!progress) progress = std::make_unique<report::Progress>("comparing", total);
    progress->advance();
  };
  return compare::compare(arm, options);
}

std::string table_text(const report::Table& table, const report::TextOptions& options = {}) {
  return report::to_text(table, options) + "\n";
}

std::string comparison_text(const compare::Comparison& comparison,
                            const std::vector<compare::MeasuredRow>& measured, bool full) {
  std::string text;
  text += describe(comparison.arm) + "\n";
  text += table_text(report::subjects_table(comparison));
  for (const auto& table : report::root_tables(comparison)) text += table_text(table);
  if (!measured.empty()) text += table_text(report::measured_table(measured));
  if (full) text += table_text(report::notes_table(comparison));
  if (!comparison.refinements.empty()) {
    text += report::convergence_legend(comparison) + "\n";
    for (const auto& table : report::convergence_tables(comparison)) text += table_text(table);
    if (!comparison.basis_notes.empty()) {
      text += "Bases of assumed_modes\n";
      for (const auto& note : comparison.basis_notes) text += report::to_paragraph(note, 2);
      text += "\n";
    }
    if (full) {
      constexpr report::TextOptions kRootAndSeries{.key_columns = 3};
      text += table_text(report::convergence_listing(comparison), kRootAndSeries);
    }
  }
  text += table_text(report::shapes_table(comparison));
  text += table_text(report::responses_table(comparison));
  text += report::verdict_line(comparison) + "\n";
  return text;
}

FolderKind comparison_folder_kind() {
  return {"a comparison", {"roots.csv"}, {".csv", ".svg", ".pdf", ".png", ".json"}, true};
}

/// The files of one arm, in `folder` of the output folder.
void add_files(const fs::path& folder, const compare::Comparison& comparison,
               const std::vector<compare::MeasuredRow>& measured,
               std::vector<measured::NamedContent>& files) {
  const auto write_csv = [&](const char* name, const report::Table& table) {
    files.push_back({folder / name, report::to_csv(table)});
  };
  write_csv("roots.csv", report::root_listing(comparison));
  write_csv("shapes.csv", report::shapes_listing(comparison));
  write_csv("responses.csv", report::responses_listing(comparison));
  if (!measured.empty()) write_csv("measured.csv", report::measured_table(measured));
  if (!comparison.refinements.empty()) {
    write_csv("convergence.csv", report::convergence_listing(comparison));
    write_csv("refinement.csv", report::refinement_listing(comparison));
  }
  for (auto& [name, svg] : report::comparison_plots(comparison)) {
    files.push_back({folder / name, std::move(svg)});
  }
}

std::string next_step(const CompareArguments& arguments) {
  const std::string arm = arguments.arm.file.empty() ? "" : " " + arguments.arm.file;
  if (arguments.output.folder.empty()) {
    return fmt::format("next: write plots and tables with  flexarm compare{} --out compared\n",
                       arm);
  }
  return fmt::format("wrote {}\nnext: the modes of this arm with  flexarm modes{}\n",
                     arguments.output.folder, arm);
}

int run_compare(const CompareArguments& arguments) {
  const auto measured = arguments.measured_file.empty()
                            ? measured::ModalTable{}
                            : measured::read_modal_table(arguments.measured_file);
  const auto options = options_of(arguments, measured);
  const auto arms = arguments.arm.arms();
  for (const auto& arm : arms) arm::require_beam(arm, "compare");
  arguments.output.prepare(comparison_folder_kind());

  std::string text;  // printed last: a reader that goes away costs no file
  std::size_t disagreeing = 0;
  std::vector<report::ComparedArm> results;
  std::vector<measured::NamedContent> files;
  for (const auto& arm : arms) {
    const auto comparison = compare_with_progress(arm, options);
    const auto rows = compare::beside_model(measured, comparison);
    text += left_out_of_roots(arm);
    text += comparison_text(comparison, rows, arguments.full);
    if (arms.size() > 1) text += "\n";
    if (!arguments.output.folder.empty()) {
      add_files(folder_of("", arm, arms.size()), comparison, rows, files);
    }
    if (!comparison.verdict.agree) ++disagreeing;
    results.push_back({comparison, rows});
  }
  if (!files.empty()) write_folder(arguments.output.folder, arguments.output.force, files);
  write_json(arguments.output.json_file, report::comparison_json(results));
  if (arms.size() > 1) {
    text += disagreeing == 0 ? fmt::format("All {} arms: agree.\n", arms.size())
                             : fmt::format("{} of {} arms: DISAGREE.\n", disagreeing, arms.size());
  }
  text += next_step(arguments);
  print(text);
  return disagreeing == 0 ? kSuccess : kFailure;
}

}  // namespace

Command add_compare(CLI::App& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* parser = program.add_subcommand(
      "compare",
      "Compare poles, zeros, mode shapes and frequency responses of the three formulations");
  add_arm_choice(*parser, arguments->arm);
  parser
      ->add_option("--measured", arguments->measured_file,
                   "Measured poles and zeros (modal CSV), listed with those of the model")
      ->check(not_empty());
  add_list_option(*parser, "--sensor", arguments->sensors, "Additional sensors, e.g. strain@0.05");
  parser->add_option("--poles", arguments->options.poles, "Number of poles and hub zeros")
      ->capture_default_str();
  parser
      ->add_option("--zeros", arguments->options.non_collocated_zeros,
                   "Number of zeros of each non-collocated sensor")
      ->capture_default_str();
  parser
      ->add_option("--tolerance", arguments->options.root_tolerance,
                   "Relative tolerance for poles and zeros")
      ->capture_default_str();
  parser
      ->add_option("--accuracy", arguments->options.wanted_accuracy,
                   "Relative accuracy for which the smallest model is sought")
      ->capture_default_str();
  parser->add_flag("--quick", arguments->quick, "Skip the convergence study");
  parser->add_flag("--full", arguments->full,
                   "Print the convergence of every root and the root counts");
  add_output_choice(*parser, arguments->output, "Folder for CSV tables and SVG plots");
  parser->footer("Exit status: 0 the formulations agree; 1 they do not; 2 unusable input.\n" +
                 example("flexarm compare rig.toml --poles 6 --out compared"));
  return {parser, [arguments] { return run_compare(*arguments); }};
}

}  // namespace flexarm::app
