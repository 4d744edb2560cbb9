#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/json_file.hpp"
#include "app/kept_inputs.hpp"
#include "app/list_option.hpp"
#include "app/measured_choice.hpp"
#include "app/output_choice.hpp"
#include "app/report_choice.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/comparison.hpp"
#include "compare/measured_verdict.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/comparison_plots.hpp"
#include "report/json/comparison_json.hpp"
#include "report/page/compare_page.hpp"
#include "report/progress.hpp"
#include "report/tables/comparison_overview.hpp"
#include "report/tables/comparison_tables.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/measured_tables.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
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
  bool verbose = false;
  OutputChoice output;
  ReportChoice report;
};

compare::Options options_of(const CompareArguments& arguments, const MeasuredFile& measured) {
  compare::Options options = arguments.options;
  // The study takes most of the time: it runs where somebody sees it.
  const bool is_shown =
      arguments.verbose || !arguments.output.folder.empty() || !arguments.output.json_file.empty();
  options.refinements = is_shown && !arguments.quick;
  const auto add = [&](const arm::Sensor& sensor) {
    if (std::ranges::find(options.sensors, sensor) == options.sensors.end()) {
      options.sensors.push_back(sensor);
    }
  };
  for (const auto& name : arguments.sensors) add(arm::parse_sensor(name));
  for (const auto& sensor : measured.sensors_with_zeros()) add(sensor);
  return options;
}

/// One comparison an arm, with a line of progress over all.
std::vector<compare::Comparison> compare_with_progress(const std::vector<arm::Arm>& arms,
                                                       compare::Options options) {
  report::Progress progress("comparing");
  std::vector<compare::Comparison> comparisons;
  for (const auto& arm : arms) {
    const auto before = static_cast<double>(comparisons.size());
    options.progress = [&](int done, int total) {
      const double of_this = static_cast<double>(done) / static_cast<double>(total);
      progress.reach((before + of_this) / static_cast<double>(arms.size()));
    };
    comparisons.push_back(compare::compare(arm, options));
  }
  return comparisons;
}

/// What was measured beside the models, and how far off it is.
std::string measured_text(const compare::Comparison& comparison,
                          const compare::MeasuredComparison& measured) {
  std::string text = screen_table(report::measured_runs_table(measured.runs)) +
                     screen_table(report::measured_table(measured.rows, comparison.subjects), 3) +
                     screen_table(report::measured_damping_table(measured.rows), 2);
  const std::string summary = report::measured_summary(measured.rows);
  if (!summary.empty()) text += screen_paragraph(summary) + "\n";
  text += screen_table(report::measured_response_table(measured.responses), 2);
  for (const auto& shapes : measured.shapes) text += screen_table(report::mac_table(shapes));
  return text;
}

/// What was compared, root by root, and how fast each formulation converges.
std::string details_text(const compare::Comparison& comparison, bool full) {
  std::string text = screen_table(report::subjects_table(comparison));
  for (const auto& table : report::root_tables(comparison)) text += screen_table(table);
  if (full) text += screen_table(report::notes_table(comparison));
  if (!comparison.refinements.empty()) {
    text += screen_paragraph(report::convergence_legend(comparison)) + "\n";
    for (const auto& table : report::convergence_tables(comparison)) text += screen_table(table);
    if (!comparison.basis_notes.empty()) {
      text += "Bases of assumed_modes\n";
      for (const auto& note : comparison.basis_notes) text += screen_paragraph(note, 2);
      text += "\n";
    }
    if (full) text += screen_table(report::convergence_listing(comparison), 3);
  }
  return text + screen_table(report::shapes_table(comparison)) +
         screen_table(report::responses_table(comparison));
}

/// The verdict on the measurement, where there is one, before that on the formulations.
std::string verdict_paragraphs(const compare::Comparison& comparison,
                               const compare::MeasuredComparison& measured) {
  const auto verdict = compare::judge(measured);
  const bool is_measured = verdict.agreement != compare::MeasuredAgreement::none;
  std::string text = screen_paragraph(report::verdict_line(comparison, is_measured));
  text = comparison.verdict.agree ? (is_measured ? text : toned(text, "agree", Tone::good))
                                  : toned(text, "DISAGREE", Tone::bad);
  if (!is_measured) return text;
  const std::string first = screen_paragraph(report::measured_verdict_line(verdict));
  switch (verdict.agreement) {
    case compare::MeasuredAgreement::agrees:
      return toned(first, "agrees", Tone::good) + text;
    case compare::MeasuredAgreement::differs:
      return toned(first, "DIFFERS", Tone::bad) + text;
    default:
      return first + text;
  }
}

std::string comparison_text(const arm::Arm& arm, const compare::Comparison& comparison,
                            const compare::MeasuredComparison& measured,
                            const CompareArguments& arguments) {
  std::string text = verdict_paragraphs(comparison, measured) + "\n";
  text += screen_rows(report::disagreements_table(comparison), kScreenRows, "--verbose");
  text += describe(comparison.arm) + left_out_of_roots(arm) + "\n";
  text += measured_text(comparison, measured);
  if (!arguments.verbose) {
    text += screen_rows(report::roots_overview(comparison), kScreenRows, "--verbose");
  }
  text += screen_table(report::agreement_overview(comparison));
  return arguments.verbose ? text + details_text(comparison, arguments.full) : text;
}

FolderKind comparison_folder_kind() {
  return {"a comparison", {"roots.csv"}, {".csv", ".svg", ".pdf", ".png", ".json", ".html"}, true};
}

/// The files of one arm, in `folder` of the output folder.
void add_files(const fs::path& folder, const compare::Comparison& comparison,
               const compare::MeasuredComparison& measured, const FigureChoice& figures,
               std::vector<measured::NamedContent>& files) {
  const auto write_csv = [&](const char* name, const report::Table& table) {
    files.push_back({folder / name, report::to_csv(table)});
  };
  write_csv("roots.csv", report::root_listing(comparison));
  write_csv("shapes.csv", report::shapes_listing(comparison));
  write_csv("responses.csv", report::responses_listing(comparison));
  if (!measured.rows.empty()) {
    write_csv("measured.csv", report::measured_table(measured.rows, comparison.subjects));
  }
  if (!measured.runs.empty()) {
    write_csv("measured-runs.csv", report::measured_runs_table(measured.runs));
    for (const auto& run : measured.runs) {
      files.push_back({folder / ("overlay-" + run.run + ".csv"),
                       report::to_csv(report::measured_run_listing(run))});
    }
  }
  const auto damping = report::measured_damping_table(measured.rows);
  if (!damping.rows.empty()) write_csv("measured-damping.csv", damping);
  if (!measured.responses.empty()) {
    write_csv("measured-responses.csv", report::measured_response_table(measured.responses));
  }
  if (!measured.shapes.empty()) write_csv("mac.csv", report::mac_listing(measured.shapes));
  if (!comparison.refinements.empty()) {
    write_csv("convergence.csv", report::convergence_listing(comparison));
    write_csv("refinement.csv", report::refinement_listing(comparison));
  }
  figures.add_to(files, folder, report::comparison_plots(comparison, measured));
}

std::string next_step(const CompareArguments& arguments) {
  const std::string arm = arguments.arm.file.empty() ? "" : " " + arguments.arm.file;
  if (arguments.output.folder.empty()) {
    return fmt::format(
        "{}next: write plots and tables with  flexarm compare{} --out compared\n",
        details_line(arguments.verbose,
                     "roots of each formulation, convergence, mode shapes, responses"),
        arm);
  }
  return fmt::format("wrote {}\nnext: the modes of this arm with  flexarm modes{}\n",
                     arguments.output.folder, arm);
}

std::string summary_of_arms(std::size_t count, std::size_t disagreeing) {
  return disagreeing == 0
             ? toned(fmt::format("All {} arms: agree.\n\n", count), "agree", Tone::good)
             : toned(fmt::format("{} of {} arms: DISAGREE.\n\n", disagreeing, count), "DISAGREE",
                     Tone::bad);
}

int run_compare(CompareArguments arguments) {
  arguments.verbose = arguments.verbose || arguments.full;

  const auto measured = arguments.measured_file.empty()
                            ? MeasuredFile{}
                            : read_measured_file(arguments.measured_file);
  const auto options = options_of(arguments, measured);
  std::string notes;
  if (!measured.arm_file.empty()) {
    std::error_code unreadable;
    if (arguments.arm.file.empty()) {
      arguments.arm.file = measured.arm_file.string();
    } else if (!fs::equivalent(arguments.arm.file, measured.arm_file, unreadable)) {
      notes = screen_note(fmt::format("the measurement names the arm {}; compared with {}",
                                      arm::shown(measured.arm_file.string()),
                                      arm::shown(arguments.arm.file))) +
              "\n";
    }
  }
  const auto arms = arguments.arm.arms();
  for (const auto& arm : arms) arm::require_beam(arm, "compare");
  for (const auto& [option, output] : {std::pair{"--json", &arguments.output.json_file},
                                       std::pair{"--out", &arguments.output.folder}}) {
    if (!output->empty()) require_no_input(option, *output, measured.files);
  }
  arguments.output.prepare(comparison_folder_kind());
  arguments.report.prepare(arguments.output.folder);

  std::string text;  // printed last: a reader that goes away costs no file
  std::size_t disagreeing = 0;
  std::vector<report::ComparedArm> results;
  std::vector<measured::NamedContent> files;
  const auto comparisons = compare_with_progress(arms, options);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const auto& arm = arms[i];
    const auto& comparison = comparisons[i];
    auto beside = beside_models(measured, arm, comparison, arms.size() == 1);
    text += comparison_text(arm, comparison, beside, arguments);
    if (!arguments.output.folder.empty()) {
      add_files(folder_of("", arm, arms.size()), comparison, beside, arguments.output.figures,
                files);
    }
    if (!comparison.verdict.agree) ++disagreeing;
    results.push_back({comparison, std::move(beside)});
  }
  if (!files.empty()) write_folder(arguments.output.folder, arguments.output.force, files);
  write_json(arguments.output.json_file, report::comparison_json(results));
  text += notes;
  if (arguments.report.is_given()) {
    arguments.report.write(
        report::page::compare_page(results, page_origin(subject_of(arguments.arm))));
  }
  if (arms.size() > 1) text = summary_of_arms(arms.size(), disagreeing) + text;
  print(text + next_step(arguments) + arguments.report.last_line());
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
                   "Measurement beside the models: modal table or frequency responses (CSV), or "
                   "measurement.toml, whose time runs are simulated; without ARM its own arm")
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
  add_verbose(*parser, arguments->verbose,
              "Print every root of each formulation, convergence, mode shapes and responses");
  parser->add_flag("--full", arguments->full,
                   "As --verbose, with the convergence of every root and the root counts");
  add_output_choice(*parser, arguments->output, {"Folder for CSV tables and figures"});
  add_report_choice(*parser, arguments->report);
  parser->footer("Exit status: 0 the formulations agree; 1 they do not; 2 unusable input. A measurement\n"
                 "does not change it: its verdict is printed first, and is measured_verdict in JSON.\n" +
                 example("flexarm compare rig.toml --poles 6 --out compared"));
  return {parser, [arguments] { return run_compare(*arguments); }};
}

}  // namespace flexarm::app
