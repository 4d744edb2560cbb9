#include "app/command.hpp"
#include "app/effect_choice.hpp"
#include "app/file_names.hpp"
#include "app/folder_place.hpp"
#include "app/json_file.hpp"
#include "app/kept_inputs.hpp"
#include "app/output_choice.hpp"
#include "app/report_choice.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "app/time_limit.hpp"
#include "arm/input_error.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/diagnosis_request.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/diagnosis_figures.hpp"
#include "report/json/diagnosis_document.hpp"
#include "report/page/diagnose_page.hpp"
#include "report/progress.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/diagnosis_tables.hpp"
#include "report/tables/empirical_law_table.hpp"
#include "report/tables/evidence_tables.hpp"
#include "report/tables/missing_force_table.hpp"
#include "report/tables/plan_tables.hpp"
#include "report/tables/prediction_error_table.hpp"
#include "report/tables/symptom_tables.hpp"
#include "report/terminal.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::app {

namespace {

constexpr const char* kDiagnosisJson = "diagnosis.json";
constexpr const char* kExtendedArm = "extended.toml";
/// Rows of tables that come behind the answer.
constexpr std::size_t kFewRows = 4;
/// Rows of the table of regimes.
constexpr std::size_t kRegimeRows = 5;
/// Lines of findings.
constexpr std::size_t kFindingLines = 14;

struct DiagnoseArguments {
  std::string file;
  diagnose::DiagnosisRequest request;
  OutputChoice output;
  bool verbose = false;
  ReportChoice report;
};

std::string verdict_definitions() {
  std::string text = "Verdicts:\n";
  for (const auto verdict : diagnose::kVerdicts) {
    text +=
        fmt::format("  {:<18}{}\n", diagnose::to_string(verdict), diagnose::definition_of(verdict));
  }
  return text + "\n";
}

FolderKind diagnosis_folder_kind() {
  return {
      "a diagnosis", {kDiagnosisJson}, {".json", ".toml", ".csv", ".svg", ".pdf", ".png", ".html"}};
}

/// Throws for an unknown predictor, and for outputs that could not be written, or would take the
/// place of what is read: before the work, not after it.
void prepare(const DiagnoseArguments& arguments, const diagnose::Experiment& experiment) {
  diagnose::require_valid(arguments.request);
  arguments.output.prepare(diagnosis_folder_kind(), experiment.files);
  if (!arguments.output.json_file.empty()) {
    require_no_input("--json: extended arm",
                     report::extended_arm_beside(arguments.output.json_file), experiment.files);
  }
  arguments.report.prepare(arguments.output.folder, experiment.files);
}

diagnose::Diagnosis diagnose_with_progress(const DiagnoseArguments& arguments,
                                           const diagnose::Experiment& experiment,
                                           const diagnose::Deadline& deadline) {
  report::Progress progress("diagnosing");
  return diagnose::diagnose(experiment, arguments.request, deadline,
                            [&](std::string_view, double fraction) {
                              progress.reach(fraction);
                              return true;
                            });
}

/// The verdict with its first word toned.
std::string verdict_paragraph(const diagnose::Diagnosis& diagnosis) {
  const std::string text = report::verdict_text(diagnosis);
  const std::string word = text.substr(0, text.find_first_of(": "));
  switch (diagnosis.verdict) {
    case diagnose::Verdict::adequate:
    case diagnose::Verdict::explained:
      return toned(screen_paragraph(text), word, Tone::good);
    case diagnose::Verdict::partly_explained:
      return toned(screen_paragraph(text), word, Tone::warning);
    case diagnose::Verdict::unexplained:
      return toned(screen_paragraph(text), word, Tone::bad);
  }
  return screen_paragraph(text);
}

/// What restricts the verdict: the search, numbers, the data, what was accepted of them.
std::string restrictions_text(const diagnose::Diagnosis& diagnosis) {
  std::string text;
  const std::string search = report::search_text(diagnosis);
  if (!search.empty()) text += screen_note(search);
  const std::string implausible = report::implausible_numbers_text(diagnosis);
  if (!implausible.empty()) text += screen_note(implausible, "warning");
  if (!diagnosis.formulations.agree) {
    text += screen_note(report::formulations_text(diagnosis.formulations), "warning");
  }
  for (const auto& notice : diagnosis.notices) text += screen_note(notice);
  for (const auto& accepted : report::accepted_texts(diagnosis)) {
    text += screen_paragraph(accepted, 2);
  }
  return text.empty() ? text : text + "\n";
}

std::string evidence_text(const diagnose::Diagnosis& diagnosis) {
  std::string text;
  for (const auto& cause : diagnosis.causes) {
    text += cause.effect + "\n";
    for (const auto& sentence : cause.evidence) text += screen_paragraph("  " + sentence, 4);
    text += screen_paragraph("  Evidence against it would be: " + cause.refuted_by + ".", 4) + "\n";
  }
  return text;
}

std::string text_of(const diagnose::Diagnosis& diagnosis, bool verbose) {
  std::string text = verdict_paragraph(diagnosis) + "\n" + restrictions_text(diagnosis);
  text += screen_table(report::cause_table(diagnosis), 2);
  text += screen_table(report::loss_table(diagnosis));
  text += screen_table(report::gain_table(diagnosis));
  if (verbose) text += evidence_text(diagnosis);
  const std::string predictor = report::predictor_text(diagnosis);
  if (!predictor.empty()) text += screen_paragraph(predictor) + "\n";
  if (verbose || is_open(diagnosis.verdict)) {
    const std::string wrong =
        report::what_is_wrong_text(diagnosis.symptoms, verbose ? kAllRows : kFindingLines,
                                   std::min(screen_width(), report::kWidestText));
    if (!wrong.empty()) text += wrong + "\n";
  }
  if (is_open(diagnosis.verdict)) {
    text += screen_rows(report::where_it_fails_table(diagnosis.symptoms),
                        verbose ? kAllRows : kRegimeRows, "--verbose", 4);
  }
  text +=
      screen_rows(report::near_miss_table(diagnosis), verbose ? kAllRows : kFewRows, "--verbose");
  text += screen_table(report::refitted_table(diagnosis));
  if (const auto& law = diagnosis.empirical_law) {
    text += screen_paragraph(report::empirical_law_text(*law)) + "\n";
  }
  if (const auto& force = diagnosis.missing_force) {
    text += screen_paragraph(report::missing_force_text(*force)) + "\n";
  }
  if (verbose) {
    if (diagnosis.formulations.agree) {
      text += screen_paragraph(report::formulations_text(diagnosis.formulations)) + "\n";
    }
    text += screen_table(report::channel_gain_table(diagnosis), 2);
    if (!diagnosis.prediction_errors.empty()) {
      text += screen_table(report::prediction_error_table(diagnosis.prediction_errors));
    }
  }
  return text + screen_rows(report::further_run_table(
                                diagnosis.next_experiments, diagnosis.next_experiments.size(),
                                "Recommended runs, by what they would distinguish"),
                            verbose ? kAllRows : kFewRows, "--verbose");
}

std::vector<measured::NamedContent> files_of(const diagnose::Diagnosis& diagnosis,
                                             const std::vector<report::NamedFigure>& figures,
                                             const report::FigureOptions& options) {
  const std::string extended = diagnose::has_extended_arm(diagnosis) ? kExtendedArm : "";
  std::vector<measured::NamedContent> files = {
      {"channels.csv", report::to_csv(report::channel_gain_table(diagnosis))},
      {"causes.csv", report::to_csv(report::cause_table(diagnosis))},
      {kDiagnosisJson, report::diagnosis_document(diagnosis, extended)}};
  if (!extended.empty()) files.push_back({extended, measured::format_arm(diagnosis.extended_arm)});
  const auto add_table = [&](const char* name, const report::Table& table) {
    if (!table.rows.empty()) files.push_back({name, report::to_csv(table)});
  };
  const diagnose::Symptoms& symptoms = diagnosis.symptoms;
  add_table("evidence.csv", report::loss_table(diagnosis));
  add_table("symptoms.csv", report::symptom_table(symptoms));
  add_table("bands.csv", report::band_table(symptoms));
  add_table("regimes.csv", report::regime_table(symptoms));
  add_table("roots.csv", report::root_shift_table(symptoms));
  add_table("hub-torque.csv", report::hub_torque_table(symptoms));
  add_table("distortion.csv", report::distortion_table(symptoms));
  add_table("run-by-run.csv", report::run_value_table(symptoms));
  add_table("prediction-errors.csv",
            report::channel_prediction_error_table(diagnosis.prediction_errors));
  if (const auto& law = diagnosis.empirical_law) {
    add_table("empirical-law.csv", report::empirical_law_table(*law));
  }
  if (const auto& force = diagnosis.missing_force) {
    add_table("missing-force.csv", report::missing_force_table(*force));
  }
  for (auto& [name, content] : report::figure_files(figures, options)) {
    add_file(name, std::move(content), files);
  }
  return files;
}

/// Returns what was not drawn, a sentence or nothing.
std::string write_files(const DiagnoseArguments& arguments, const diagnose::Experiment& experiment,
                        const diagnose::Diagnosis& diagnosis) {
  std::string left_out;
  if (!arguments.output.folder.empty()) {
    const report::DiagnosisPlots plots = report::diagnosis_plots(experiment, diagnosis);
    left_out = plots.left_out;
    write_folder(arguments.output.folder, arguments.output.force,
                 files_of(diagnosis, plots.plots, arguments.output.figures.options()));
  }
  if (is_standard_output(arguments.output.json_file)) {
    write_json(arguments.output.json_file, report::diagnosis_document(diagnosis, ""));
  } else if (!arguments.output.json_file.empty()) {
    report::write_diagnosis(diagnosis, arguments.output.json_file);
  }
  if (arguments.report.is_given()) {
    arguments.report.write(
        report::page::diagnose_page(experiment, diagnosis, page_origin(arguments.file)));
  }
  return left_out;
}

int run_diagnose(const DiagnoseArguments& arguments) {
  const auto begun = std::chrono::steady_clock::now();
  const diagnose::Deadline deadline = diagnose::deadline_of(arguments.request, begun);
  const diagnose::Experiment experiment =
      diagnose::experiment_of(compare::read_recording(arguments.file), arguments.request, deadline);
  prepare(arguments, experiment);
  const diagnose::Diagnosis diagnosis = diagnose_with_progress(arguments, experiment, deadline);
  std::string text = text_of(diagnosis, arguments.verbose);
  std::string left_out;
  try {
    left_out = write_files(arguments, experiment, diagnosis);
  } catch (const arm::InputError&) {
    print(text);
    throw;
  }
  const std::string details =
      details_line(arguments.verbose, "evidence, residual analysis, channels, formulations");
  if (arguments.output.folder.empty()) {
    text += details;
    text +=
        fmt::format("next: the extended arm and tables with  flexarm diagnose {} --out diagnosis\n",
                    arm::shown(arguments.file));
  } else {
    if (!left_out.empty()) text += screen_note(left_out);
    text += details + fmt::format("wrote {}\n", arguments.output.folder);
  }
  text += arguments.report.last_line();
  print(text);
  return kSuccess;
}

}  // namespace

Command add_diagnose(CLI::App& program) {
  const auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* parser = program.add_subcommand(
      "diagnose", "Name the causes of the differences between a simulation and measured data");
  parser->add_option("FILE", arguments->file, "measurement.toml")->required()->check(not_empty());
  add_effect_choice(*parser, arguments->request.effects);
  const auto add_names = [&](const char* option, std::vector<std::string>& names,
                             const char* help) {
    parser->add_option(option, names, help)->delimiter(',')->allow_extra_args(false);
  };
  add_names("--exclude", arguments->request.excluded,
            "Effects that are not searched for; on one sensor: \"sensor_gain on hub_angle\"");
  add_names("--accept", arguments->request.accepted,
            "Data checks whose findings are no faults of these data, e.g. dead_channel: they are "
            "reported as accepted, and exclude no channel and no run");
  add_verbose(*parser, arguments->verbose,
              "Print evidence, residual analysis, NRMSE of each channel, formulations");
  add_time_limit(*parser, arguments->request.time_limit_s);
  parser->add_option("--max-causes", arguments->request.most_causes,
                     "The most causes to name; default: as many as the data show");
  parser
      ->add_option(
          "--predictor", arguments->request.predictor,
          "How time runs are predicted: output_error (the torque alone drives the arm), "
          "closed_loop (the reference drives controller and arm), grey_box (a Kalman filter, with "
          "an unrecorded torque on the hub), torque_balance (the residual hub torque for the "
          "motion as filtered), driven_by_motion (the measured motion of the hub drives the beam; "
          "torque and hub are not judged), frequency_response (responses estimated of the runs) or "
          "auto")
      ->capture_default_str();
  add_names("--policy", arguments->request.policy,
            "NAME=NUMBER: a number of the search that is not as documented, for studies of it");
  add_output_choice(
      *parser, arguments->output,
      {.folder = "New folder for the extended arm, tables as CSV, figures and the JSON",
       .force = "Replace what this command wrote in the folder",
       .json_file = "JSON file; the extended arm is written beside it; - for standard output"});
  add_report_choice(*parser, arguments->report);
  parser->footer(verdict_definitions() +
                 example("flexarm diagnose simulated/measurement.toml --out diagnosis"));
  return {parser, [arguments] { return run_diagnose(*arguments); }};
}

}  // namespace flexarm::app
