#include "diagnose/planning/plan.hpp"

#include "app/command.hpp"
#include "app/effect_choice.hpp"
#include "app/folder_place.hpp"
#include "app/json_file.hpp"
#include "app/output_choice.hpp"
#include "app/report_choice.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "diagnose/planning/plan_task.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/separation_figure.hpp"
#include "report/json/plan_json.hpp"
#include "report/page/plan_page.hpp"
#include "report/progress.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/plan_tables.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlanJson = "plan.json";
constexpr const char* kBetterPlan = "improved-plan.toml";
/// Further runs that are printed.
constexpr std::size_t kPrintedRuns = 8;

struct PlanArguments {
  std::string arm_file;
  std::string plan_file;
  std::vector<std::string> effects;
  std::vector<std::string> refitted;
  std::string better_file;
  OutputChoice output;
  bool verbose = false;
  ReportChoice report;
};

FolderKind plan_folder_kind() {
  return {"a plan", {kPlanJson}, {".json", ".toml", ".csv", ".svg", ".pdf", ".png", ".html"}};
}

diagnose::Plan plan_with_progress(const PlanArguments& arguments) {
  const arm::Arm arm = measured::read_arm_file(arguments.arm_file, effects::vocabulary());
  const auto task =
      diagnose::plan_task(arm, diagnose::read_measurement_plan(arguments.plan_file),
                          {.effects = arguments.effects, .refitted = arguments.refitted});
  arguments.output.prepare(plan_folder_kind());
  arguments.report.prepare(arguments.output.folder);
  report::Progress progress("planning");
  return diagnose::plan_experiment(task.arm, task.planned, task.hypotheses, task.options,
                                   [&](std::string_view, double fraction) {
                                     progress.reach(fraction);
                                     return true;
                                   });
}

/// The runs that the improved plan adds, or that none helps; empty where all can be told apart.
std::string improvement_text(const diagnose::Plan& plan) {
  if (plan.ties.empty()) return "";
  if (plan.added.empty()) {
    return screen_paragraph(
               "None of the additional runs considered resolves an indistinguishable pair.") +
           "\n";
  }
  return screen_table(report::further_run_table(
      plan.added, plan.added.size(), "Improved plan: additional runs, in order of choice"));
}

std::string text_of_plan(const diagnose::Plan& plan, bool verbose) {
  std::string text = screen_paragraph(report::plan_summary(plan)) + "\n";
  for (const auto& notice : plan.notices) text += screen_note(notice);
  if (!plan.notices.empty()) text += "\n";
  if (!plan.ties.empty()) {
    text += screen_rows(report::tie_table(plan), verbose ? kAllRows : kScreenRows,
                        "--verbose, --out or --json", 2);
  }
  text += improvement_text(plan);
  text += screen_rows(report::detection_table(plan), verbose ? kAllRows : kScreenRows,
                      "--verbose, --out or --json");
  if (!verbose) return text;
  text += report::separation_matrix(plan) + "\n";
  if (plan.ties.empty()) return text;
  return text + screen_table(report::further_run_table(plan.further, kPrintedRuns,
                                                       "Value of one additional run"));
}

/// Whether two effects can be told apart or not at all: of one effect there is nothing to draw.
bool has_pairs(const diagnose::Plan& plan) {
  return std::ranges::any_of(plan.separations, [](const auto& row) {
    return std::ranges::any_of(row, [](const auto& pair) { return pair.has_value(); });
  });
}

void write_plan(const PlanArguments& arguments, const diagnose::Plan& plan) {
  const std::string better = diagnose::format_measurement_plan(plan.better);
  const std::string json = report::plan_document(plan);
  if (!arguments.output.folder.empty()) {
    std::vector<measured::NamedContent> files = {
        {"effects.csv", report::to_csv(report::detection_table(plan))},
        {"separations.csv", report::to_csv(report::separation_table(plan))},
        {"leads.csv", report::to_csv(report::lead_table(plan))},
        {kBetterPlan, better},
        {kPlanJson, json}};
    if (has_pairs(plan)) {
      arguments.output.figures.add_to(files, "",
                                      {{"separations", report::separation_figure(plan)}});
    }
    write_folder(arguments.output.folder, arguments.output.force, files);
  }
  if (!arguments.better_file.empty()) measured::write_atomically(arguments.better_file, better);
  write_json(arguments.output.json_file, json);
  if (arguments.report.is_given()) {
    arguments.report.write(report::page::plan_page(plan, page_origin(arguments.plan_file)));
  }
}

int run_plan(const PlanArguments& arguments) {
  const diagnose::Plan plan = plan_with_progress(arguments);
  std::string text = text_of_plan(plan, arguments.verbose);
  try {
    write_plan(arguments, plan);
  } catch (const arm::InputError&) {
    print(text);
    throw;
  }
  text += details_line(arguments.verbose, "separations, indistinguishable pairs, further runs");
  if (!arguments.output.folder.empty()) {
    text += fmt::format("wrote {}\n", arguments.output.folder);
  } else if (!arguments.better_file.empty()) {
    text += fmt::format("wrote {}\n", arguments.better_file);
  } else {
    text +=
        fmt::format("next: write the improved plan with  flexarm plan {} {} --write {}\n",
                    arm::shown(arguments.arm_file), arm::shown(arguments.plan_file), kBetterPlan);
  }
  text += arguments.report.last_line();
  print(text);
  return kSuccess;
}

}  // namespace

Command add_plan(CLI::App& program) {
  const auto arguments = std::make_shared<PlanArguments>();
  CLI::App* parser = program.add_subcommand(
      "plan", "Detectability and distinguishability of effects in a planned experiment");
  parser->add_option("ARM", arguments->arm_file, "arm.toml")->required()->check(not_empty());
  parser->add_option("PLAN", arguments->plan_file, "measurement-plan.toml")
      ->required()
      ->check(not_empty());
  add_effect_choice(*parser, arguments->effects);
  parser
      ->add_option(
          "--refit", arguments->refitted,
          "Effects treated as nuisance parameters, comma-separated; default: the arm file is exact")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_verbose(*parser, arguments->verbose,
              "Print all effects, the matrix of separations, indistinguishable pairs and the value "
              "of further runs");
  parser->add_option("--write", arguments->better_file, "File for the improved plan")
      ->check(not_empty());
  add_output_choice(*parser, arguments->output,
                    {"New folder for the improved plan, CSV tables, a figure and JSON"});
  add_report_choice(*parser, arguments->report);
  parser->footer(example("flexarm plan rig.toml measurement-plan.toml --write improved-plan.toml"));
  return {parser, [arguments] { return run_plan(*arguments); }};
}

}  // namespace flexarm::app
