#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/file_names.hpp"
#include "app/json_file.hpp"
#include "app/kept_inputs.hpp"
#include "app/list_option.hpp"
#include "app/measured_choice.hpp"
#include "app/output_choice.hpp"
#include "app/report_choice.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "app/time_limit.hpp"
#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "arm/rigid_hub.hpp"
#include "arm/time_limit.hpp"
#include "compare/comparison.hpp"
#include "compare/measured_verdict.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/comparison_plots.hpp"
#include "report/figures/figure_files.hpp"
#include "report/json/comparison_json.hpp"
#include "report/page/compare_page.hpp"
#include "report/progress.hpp"
#include "report/tables/comparison_overview.hpp"
#include "report/tables/comparison_tables.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/measured_tables.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
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
  double measured_tolerance_percent = compare::kMeasuredTolerance_percent;
  std::vector<std::string> sensors;
  compare::Options options;
  bool quick = false;
  bool full = false;
  bool verbose = false;
  std::optional<double> time_limit_s = {};
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
  if (!measured.runs_left_out.empty()) {
    text += screen_note(fmt::format("of another payload than this arm, and not compared: {}",
                                    fmt::join(measured.runs_left_out, ", "))) +
            "\n";
  }
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
                               const compare::MeasuredVerdict& measured) {
  const bool is_measured = measured.agreement != compare::MeasuredAgreement::none;
  const std::string formulations = screen_paragraph(report::verdict_line(comparison, is_measured));
  const std::string text = comparison.verdict.agree ? toned(formulations, "agree", Tone::good)
                                                    : toned(formulations, "DISAGREE", Tone::bad);
  if (!is_measured) return text;
  const std::string first = screen_paragraph(report::measured_verdict_line(measured));
  const bool agrees = measured.agreement == compare::MeasuredAgreement::agrees;
  return (agrees ? toned(first, "agrees", Tone::good) : toned(first, "DIFFERS", Tone::bad)) + text;
}

std::string comparison_text(const arm::Arm& arm, const compare::Comparison& comparison,
                            const compare::MeasuredComparison& measured,
                            const CompareArguments& arguments) {
  std::string text = verdict_paragraphs(comparison, compare::judge(measured)) + "\n";
  text += screen_rows(report::disagreements_table(comparison), kScreenRows, "--verbose");
  const bool has_models = !comparison.subjects.empty();
  text += describe(comparison.arm) + (has_models ? left_out_of_roots(arm) : "") + "\n";
  text += measured_text(comparison, measured);
  const std::string out_of_time = report::out_of_time_text(comparison, measured);
  if (!out_of_time.empty()) text += screen_note(out_of_time, "warning") + "\n";
  if (!has_models) return text;
  if (!arguments.verbose) {
    text += screen_rows(report::roots_overview(comparison), kScreenRows, "--verbose");
  }
  text += screen_table(report::agreement_overview(comparison));
  return arguments.verbose ? text + details_text(comparison, arguments.full) : text;
}

FolderKind comparison_folder_kind() {
  return {"a comparison",
          {"roots.csv", "measured-runs.csv"},
          {".csv", ".svg", ".pdf", ".png", ".json", ".html"},
          true};
}

/// The files of one arm.
std::vector<measured::NamedContent> files_of(const compare::Comparison& comparison,
                                             const compare::MeasuredComparison& measured,
                                             const FigureChoice& figures) {
  std::vector<measured::NamedContent> files;
  const auto write_csv = [&](const std::string& name, const report::Table& table) {
    add_file(name + ".csv", report::to_csv(table), files);
  };
  if (!comparison.subjects.empty()) {
    write_csv("roots", report::root_listing(comparison));
    write_csv("shapes", report::shapes_listing(comparison));
    write_csv("responses", report::responses_listing(comparison));
  }
  if (!measured.rows.empty()) {
    write_csv("measured", report::measured_table(measured.rows, comparison.subjects));
  }
  if (!measured.runs.empty()) {
    write_csv("measured-runs", report::measured_runs_table(measured.runs));
    for (const auto& run : measured.runs) {
      write_csv("overlay-" + run.run, report::measured_run_listing(run));
    }
  }
  const auto damping = report::measured_damping_table(measured.rows);
  if (!damping.rows.empty()) write_csv("measured-damping", damping);
  if (!measured.responses.empty()) {
    write_csv("measured-responses", report::measured_response_table(measured.responses));
  }
  if (!measured.shapes.empty()) write_csv("mac", report::mac_listing(measured.shapes));
  if (!comparison.refinements.empty()) {
    write_csv("convergence", report::convergence_listing(comparison));
    write_csv("refinement", report::refinement_listing(comparison));
  }
  const auto plots = report::comparison_plots(comparison, measured);
  for (auto& [name, content] : report::figure_files(plots, figures.options())) {
    add_file(name, std::move(content), files);
  }
  return files;
}

std::string next_step(const CompareArguments& arguments, bool is_measurement_far) {
  const std::string arm = arguments.arm.file.empty() ? "" : " " + arguments.arm.file;
  std::string lines = arguments.output.folder.empty()
                          ? details_line(arguments.verbose,
                                         "roots of each formulation, convergence, mode shapes, "
                                         "responses")
                          : fmt::format("wrote {}\n", arguments.output.folder);
  if (is_measurement_far && fs::path(arguments.measured_file).extension() == ".toml") {
    lines += fmt::format("next: what does the simulation lack?  flexarm diagnose {}\n",
                         arguments.measured_file);
  } else if (arguments.output.folder.empty()) {
    const std::string measured =
        arguments.measured_file.empty() ? "" : " --measured " + arguments.measured_file;
    lines += fmt::format("next: write plots and tables with  flexarm compare{}{} --out compared\n",
                         arm, measured);
  } else {
    lines += fmt::format("next: the modes of this arm with  flexarm modes{}\n", arm);
  }
  return lines;
}

/// Of several arms: how many the measurement agrees with, and of how many the formulations agree.
std::string summary_of_arms(const std::vector<report::ComparedArm>& arms) {
  std::size_t disagreeing = 0;
  std::size_t measured = 0;
  std::size_t differing = 0;
  for (const auto& arm : arms) {
    const auto agreement = compare::judge(arm.measured).agreement;
    disagreeing += arm.comparison.verdict.agree ? 0U : 1U;
    measured += agreement == compare::MeasuredAgreement::none ? 0U : 1U;
    differing += agreement == compare::MeasuredAgreement::differs ? 1U : 0U;
  }
  std::string text =
      disagreeing == 0
          ? toned(fmt::format("All {} arms: agree.\n\n", arms.size()), "agree", Tone::good)
          : toned(fmt::format("{} of {} arms: DISAGREE.\n\n", disagreeing, arms.size()), "DISAGREE",
                  Tone::bad);
  if (measured == 0) return text;
  const std::string first =
      differing == 0
          ? toned(fmt::format("Measurement: agrees with {} arms.\n", measured), "agrees",
                  Tone::good)
          : toned(fmt::format("Measurement: DIFFERS from {} of {} arms.\n", differing, measured),
                  "DIFFERS", Tone::bad);
  return first + "Formulations, " + text;
}

/// Takes the arm of the measurement where no other is named; else a note says that they differ.
std::string choose_arm(const MeasuredFile& measured, ArmChoice& arm) {
  if (measured.arm_file.empty()) return "";
  if (arm.file.empty()) {
    arm.file = measured.arm_file.string();
    return "";
  }
  std::error_code unreadable;
  if (fs::equivalent(arm.file, measured.arm_file, unreadable)) return "";
  return screen_note(fmt::format("the measurement names the arm {}; compared with {}",
                                 arm::shown(measured.arm_file.string()), arm::shown(arm.file))) +
         "\n";
}

/// The measurement beside each arm, with a line of progress over the simulated runs.
std::vector<compare::MeasuredComparison> measured_with_progress(
    const MeasuredFile& measured, const std::vector<arm::Arm>& arms,
    const std::vector<compare::Comparison>& comparisons, const CompareArguments& arguments,
    const arm::Deadline& deadline) {
  report::Progress progress("comparing the measurement",
                            std::ssize(arms) * std::ssize(measured.runs));
  std::vector<compare::MeasuredComparison> beside;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    beside.push_back(beside_models(measured, arms[i], comparisons[i], arms.size() == 1, deadline,
                                   [&] { progress.advance(); }));
    beside.back().tolerance_percent = arguments.measured_tolerance_percent;
  }
  return beside;
}

/// Throws InputError where the time limit left nothing of a measurement to compare.
void require_comparison(const std::vector<compare::MeasuredComparison>& beside,
                        const CompareArguments& arguments) {
  for (const auto& measured : beside) {
    if (measured.runs_out_of_time.empty()) continue;
    if (compare::judge(measured).agreement != compare::MeasuredAgreement::none) continue;
    throw arm::InputError(
        fmt::format("--time-limit = {:g} s: no run could be simulated within the limit; raise it",
                    arguments.time_limit_s.value_or(0.0)));
  }
}

int run_compare(CompareArguments arguments) {
  const arm::Deadline deadline = arm::deadline_of(
      arguments.time_limit_s, std::chrono::steady_clock::now(), arm::on_command_line);
  arguments.verbose = arguments.verbose || arguments.full;

  const auto measured = arguments.measured_file.empty()
                            ? MeasuredFile{}
                            : read_measured_file(arguments.measured_file);
  arm::require_in_range("measured_tolerance", arguments.measured_tolerance_percent, "%",
                        arm::kNotNegative);
  auto options = options_of(arguments, measured);
  options.deadline = deadline;
  const std::string note = choose_arm(measured, arguments.arm);
  const auto arms = arguments.arm.arms();
  for (const auto& arm : arms) {
    if (!measured.is_in_time()) arm::require_beam(arm, "compare");
  }
  for (const auto& [option, output] : {std::pair{"--json", &arguments.output.json_file},
                                       std::pair{"--out", &arguments.output.folder}}) {
    if (!output->empty()) require_no_input(option, *output, measured.files);
  }
  arguments.output.prepare(comparison_folder_kind());
  arguments.report.prepare(arguments.output.folder);

  std::string text;  // printed last: a reader that goes away costs no file
  bool do_formulations_agree = true;
  bool is_measurement_far = false;
  std::vector<report::ComparedArm> results;
  std::vector<measured::NamedContent> files;
  const auto comparisons = compare_with_progress(arms, options);
  auto beside = measured_with_progress(measured, arms, comparisons, arguments, deadline);
  require_comparison(beside, arguments);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    text += comparison_text(arms[i], comparisons[i], beside[i], arguments);
    if (!arguments.output.folder.empty()) {
      const fs::path folder = folder_of("", arms[i], arms.size());
      for (auto& [name, content] : files_of(comparisons[i], beside[i], arguments.output.figures)) {
        files.push_back({folder / name, std::move(content)});
      }
    }
    do_formulations_agree = do_formulations_agree && comparisons[i].verdict.agree;
    is_measurement_far = is_measurement_far ||
                         compare::judge(beside[i]).agreement == compare::MeasuredAgreement::differs;
    results.push_back({comparisons[i], std::move(beside[i])});
  }
  if (!files.empty()) write_folder(arguments.output.folder, arguments.output.force, files);
  write_json(arguments.output.json_file, report::comparison_json(results));
  if (arguments.report.is_given()) {
    arguments.report.write(
        report::page::compare_page(results, page_origin(subject_of(arguments.arm))));
  }
  if (arms.size() > 1) text = summary_of_arms(results) + text;
  print(text + note + next_step(arguments, is_measurement_far) + arguments.report.last_line());
  return do_formulations_agree && !is_measurement_far ? kSuccess : kFailure;
}

}  // namespace

Command add_compare(CLI::App& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* parser = program.add_subcommand(
      "compare",
      "Compare the three formulations, and measured data with them: poles, zeros, shapes, "
      "responses, time runs");
  add_arm_choice(*parser, arguments->arm);
  parser
      ->add_option("--measured", arguments->measured_file,
                   "Measurement beside the models: modal table or frequency responses (CSV), or "
                   "measurement.toml, whose time runs are simulated; without ARM its own arm")
      ->check(not_empty());
  parser
      ->add_option("--measured-tolerance", arguments->measured_tolerance_percent,
                   "Largest difference from a measurement without standard deviations [%]")
      ->capture_default_str();
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
  add_time_limit(*parser, arguments->time_limit_s);
  add_verbose(*parser, arguments->verbose,
              "Print every root of each formulation, convergence, mode shapes and responses");
  parser->add_flag("--full", arguments->full,
                   "As --verbose, with the convergence of every root and the root counts");
  add_output_choice(*parser, arguments->output, {"Folder for CSV tables and figures"});
  add_report_choice(*parser, arguments->report);
  parser->footer(
      "Exit status: 0 the formulations agree, and the measurement with the model; 1 they do not; 2 "
      "unusable input.\n" +
      example("flexarm compare rig.toml --poles 6 --out compared"));
  return {parser, [arguments] { return run_compare(*arguments); }};
}

}  // namespace flexarm::app
