#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/json_file.hpp"
#include "app/list_option.hpp"
#include "app/output_choice.hpp"
#include "app/report_choice.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "app/version.hpp"
#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/paper/paper_sweeps.hpp"
#include "compare/sweeps/sweep_result.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/sweep_figures.hpp"
#include "report/json/sweep_json.hpp"
#include "report/page/sweep_page.hpp"
#include "report/progress.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/sweep_tables.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tbb/global_control.h>
#include <utility>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

constexpr int kMostThreads = 1024;
constexpr std::size_t kEventsPrinted = 12;

struct SweepArguments {
  ArmChoice arm;
  std::vector<std::string> over;
  std::optional<int> figure;
  std::vector<std::string> formulations;
  std::optional<int> poles;
  std::optional<int> zeros;
  std::vector<std::string> sensors;
  bool roots_only = false;
  compare::SweepTolerances tolerances;
  int threads = 0;
  bool resume = false;
  bool verbose = false;
  OutputChoice output;
  ReportChoice report;
};

arm::Arm arm_of(const SweepArguments& arguments) {
  const auto arms = arguments.arm.arms();
  for (const auto& arm : arms) arm::require_beam(arm, "sweep");
  if (arms.size() > 1) {
    throw arm::InputError(
        "--payload-mass: needs one value; for several use --over payload.mass=A,B,C");
  }
  return response::take_apart(arms.front()).linear;
}

/// A number of the arm that is swept is not the one that an option gives.
void refuse_swept(const ArmChoice& choice, const std::vector<compare::SweepAxis>& axes) {
  struct Given {
    const char* option;
    bool is_given;
    std::array<const char*, 2> parameters;
  };
  const std::array<Given, 3> options = {
      {{"--payload-mass",
        !choice.payload_masses_kg.empty(),
        {"payload.mass", "payload_mass_ratio"}},
       {"--payload-inertia", choice.payload_inertia_kg_m2.has_value(), {"payload.inertia", ""}},
       {"--hub-inertia",
        choice.hub_inertia_kg_m2.has_value(),
        {"hub.inertia", "hub_inertia_ratio"}}}};
  for (const auto& axis : axes) {
    for (const auto& given : options) {
      if (!given.is_given || std::ranges::count(given.parameters, axis.parameter.name) == 0) {
        continue;
      }
      throw arm::InputError(
          fmt::format("{}: {} is a sweep parameter", given.option, axis.parameter.name));
    }
  }
}

/// The models named, in the order of `all`; all of them where none is.
std::vector<compare::Model> chosen_models(const std::vector<std::string>& names,
                                          std::vector<compare::Model> all) {
  for (const auto& name : names) response::require_formulation("--formulation", name);
  std::erase_if(all, [&](const compare::Model& model) {
    return !names.empty() && std::ranges::find(names, model.name) == names.end();
  });
  return all;
}

void refuse_beside_figure(const char* option, bool given) {
  if (given) throw arm::InputError(fmt::format("{}: --figure has its own", option));
}

/// The figure of the paper asked for; its task is the one to run.
std::optional<compare::PaperSweep> figure_of(const SweepArguments& arguments) {
  if (!arguments.figure) return std::nullopt;
  refuse_beside_figure("--over", !arguments.over.empty());
  refuse_beside_figure("--poles", arguments.poles.has_value());
  refuse_beside_figure("--zeros", arguments.zeros.has_value());
  refuse_beside_figure("--sensor", !arguments.sensors.empty());
  auto sweep = compare::paper_sweep(*arguments.figure, arm_of(arguments));
  sweep.task.models = chosen_models(arguments.formulations, std::move(sweep.task.models));
  return sweep;
}

compare::SweepTask task_of(const SweepArguments& arguments) {
  if (arguments.over.empty()) {
    throw arm::InputError("--over: give one or two parameters, e.g. --over payload.mass=0:0.5:200");
  }
  compare::SweepTask task;
  for (const auto& text : arguments.over) task.axes.push_back(compare::parse_axis(text));
  task.arm = arm_of(arguments);
  task.questions.poles = arguments.poles.value_or(task.questions.poles);
  task.questions.zeros = arguments.zeros.value_or(task.questions.zeros);
  task.questions.modes = !arguments.roots_only;
  if (!arguments.sensors.empty()) task.questions.sensors.clear();
  for (const auto& name : arguments.sensors) {
    const auto sensor = arm::parse_sensor(name);
    if (std::ranges::find(task.questions.sensors, sensor) == task.questions.sensors.end()) {
      task.questions.sensors.push_back(sensor);
    }
  }
  int roots = task.questions.poles;
  for (const auto& sensor : task.questions.sensors) {
    roots = std::max(roots, compare::zeros_asked(sensor, task.questions));
  }
  task.models = chosen_models(arguments.formulations, compare::standard_models(roots));
  return task;
}

constexpr const char* kCheckpoint = "sweep.checkpoint";

FolderKind sweep_folder_kind() {
  return {"a sweep",
          {"sweep.csv", "figure-18.csv", "figure-19.csv", kCheckpoint},
          {".csv", ".svg", ".pdf", ".png", ".json", ".html", ".checkpoint"}};
}

/// Beside the output, or nowhere.
fs::path checkpoint_of(const OutputChoice& output) {
  if (!output.folder.empty()) return fs::path(output.folder) / kCheckpoint;
  const bool has_file = !output.json_file.empty() && !is_standard_output(output.json_file);
  return has_file ? output.json_file + ".checkpoint" : "";
}

/// The folder of an interrupted sweep is continued with --resume, or begun anew with --force.
void prepare(const OutputChoice& output, bool resume) {
  OutputChoice chosen = output;
  const bool is_interrupted = !output.folder.empty() && is_begun(output.folder, kCheckpoint);
  if (is_interrupted && !resume && !output.force) {
    throw arm::InputError(
        fmt::format("{}: has the checkpoint of an interrupted sweep; --resume continues it, "
                    "--force begins anew",
                    arm::shown(output.folder)));
  }
  if (is_interrupted) chosen.force = true;
  chosen.prepare(sweep_folder_kind());
  if (!output.folder.empty()) measured::make_folder(output.folder);  // for the checkpoint
}

compare::SweepResult run_task(const compare::SweepTask& task, const SweepArguments& arguments,
                              const Interruption& interruption) {
  report::Progress progress("sweeping", static_cast<std::int64_t>(task.points()));
  compare::SweepRun run;
  run.progress = [&progress] { progress.advance(); };
  run.stop = &interruption.requested();
  run.checkpoint = checkpoint_of(arguments.output);
  run.resume = arguments.resume;
  run.program_version = version_text();
  auto values = compare::evaluate(task, run);
  if (values.resumed > 0) {
    print(fmt::format("{} of {} points from {}\n", values.resumed, task.points(),
                      run.checkpoint.string()));
  }
  return compare::assemble(task, std::move(values), run, arguments.tolerances);
}

void say_interrupted(const compare::SweepInterrupted& interrupted, const fs::path& checkpoint) {
  const std::string how =
      checkpoint.empty() ? "no checkpoint without --out or --json"
      : fs::exists(checkpoint)
          ? fmt::format("continue with the same command and --resume from {}", checkpoint.string())
          : "run too short for a checkpoint";
  const std::string line = fmt::format("flexarm: {}; {}\n", interrupted.what(), how);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

std::string verdict_paragraph(const compare::SweepResult& result) {
  const std::string text = screen_paragraph(report::sweep_verdict_line(result));
  const std::string word = text.substr(0, text.find_first_of(": "));
  return toned(text, word, result.agrees() ? Tone::good : Tone::bad) + "\n";
}

void print_result(const compare::SweepResult& result, const arm::Arm& full_arm, bool verbose) {
  std::string text = result.agreement.empty() ? "" : verdict_paragraph(result);
  if (!result.agrees() && !verbose) text += screen_table(report::sweep_agreement_table(result));
  text += describe(full_arm) + left_out_of_roots(full_arm) + "\n";
  text += screen_paragraph(report::sweep_axes_lines(result)) + "\n";
  for (const auto& table : report::sweep_range_tables(result)) text += screen_table(table);
  if (!result.events.empty()) {
    text += screen_rows(report::sweep_events_table(result, result.events.size()),
                        verbose ? kAllRows : kEventsPrinted, "--verbose, --out or --json", 2);
  }
  if (verbose) {
    for (const auto& table : report::sweep_mode_tables(result)) text += screen_table(table);
    text += screen_table(report::sweep_models_table(result));
    text += screen_table(report::sweep_agreement_table(result));
  }
  print(text);
}

std::vector<measured::NamedContent> paper_files(const SweepArguments& arguments,
                                                const compare::PaperSweep& figure,
                                                const compare::SweepResult& result) {
  const std::string name = fmt::format("figure-{}", *arguments.figure);
  std::vector<measured::NamedContent> files = {{name + ".csv", report::sweep_csv(result)}};
  arguments.output.figures.add_to(files, "", {{name, report::paper_sweep_figure(figure, result)}});
  return files;
}

std::vector<measured::NamedContent> sweep_files(const SweepArguments& arguments,
                                                const compare::SweepResult& result) {
  constexpr auto kAll = std::numeric_limits<std::size_t>::max();
  std::vector<measured::NamedContent> files = {
      {"sweep.csv", report::sweep_csv(result)},
      {"events.csv", report::to_csv(report::sweep_events_table(result, kAll))},
      {"agreement.csv", report::to_csv(report::sweep_agreement_table(result))}};
  arguments.output.figures.add_to(files, "", report::sweep_plots(result));
  return files;
}

std::string next_step(const SweepArguments& arguments) {
  const std::string arm = arguments.arm.file.empty() ? "" : " " + arguments.arm.file;
  if (!arguments.output.folder.empty()) {
    return fmt::format("wrote {}\nnext: one arm of the grid in detail with  flexarm compare{}\n",
                       arguments.output.folder, arm);
  }
  if (arguments.figure) {
    return fmt::format(
        "next: write the figure and its values with  flexarm sweep{} --figure {} --out figures\n",
        arm, *arguments.figure);
  }
  return fmt::format(
      "next: write curves and all values with  flexarm sweep{} --over {} --out swept\n", arm,
      fmt::join(arguments.over, " --over "));
}

int run_sweep(const SweepArguments& arguments) {
  if (arguments.threads < 0 || arguments.threads > kMostThreads) {
    throw arm::out_of_range("--threads", arguments.threads, "",
                            fmt::format("from 1 to {}, or 0 for one per core", kMostThreads));
  }
  arm::require_in_range("--tolerance", arguments.tolerances.roots, "", arm::kPositive);
  std::optional<tbb::global_control> limit;
  if (arguments.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<std::size_t>(arguments.threads));
  }
  const auto checkpoint = checkpoint_of(arguments.output);
  if (arguments.resume && checkpoint.empty()) {
    throw arm::InputError("--resume: give the --out or --json of the interrupted sweep");
  }
  const auto figure = figure_of(arguments);
  const auto task = figure ? figure->task : task_of(arguments);
  refuse_swept(arguments.arm, task.axes);
  compare::require_valid(task);
  prepare(arguments.output, arguments.resume);
  arguments.report.prepare(arguments.output.folder);

  const Interruption interruption;
  compare::SweepResult result;
  try {
    result = run_task(task, arguments, interruption);
  } catch (const compare::SweepInterrupted& interrupted) {
    say_interrupted(interrupted, checkpoint);
    interruption.end_program();
  }
  if (const auto& folder = arguments.output.folder; !folder.empty()) {
    const bool begun = is_begun(folder, kCheckpoint);
    write_folder(folder, arguments.output.force || begun,
                 figure ? paper_files(arguments, *figure, result) : sweep_files(arguments, result));
  }
  write_json(arguments.output.json_file, report::sweep_json(result));
  if (arguments.report.is_given()) {
    arguments.report.write(
        report::page::sweep_page(result, page_origin(subject_of(arguments.arm))));
  }
  if (!checkpoint.empty()) fs::remove(checkpoint);
  print_result(result, arguments.arm.arms().front(), arguments.verbose);
  print(next_step(arguments) + arguments.report.last_line());
  return result.agrees() ? kSuccess : kFailure;
}

}  // namespace

Command add_sweep(CLI::App& program) {
  const auto arguments = std::make_shared<SweepArguments>();
  CLI::App* parser = program.add_subcommand(
      "sweep", "Compute poles, zeros, damping and hub slopes over one or two parameters");
  add_arm_choice(*parser, arguments->arm);
  parser
      ->add_option("--over", arguments->over,
                   "KEY=START:END:COUNT, KEY=log:START:END:COUNT or KEY=A,B,C; twice for a grid. "
                   "KEY: key of the arm file, effects.NAME.PARAMETER, eta or epsilon")
      ->check(not_empty())
      ->allow_extra_args(false);
  parser->add_option("--figure", arguments->figure,
                     "18 or 19: poles or zeros over payload as in the paper, instead of --over");
  parser
      ->add_option("--formulation", arguments->formulations,
                   "exact_tf, fem, assumed_modes, comma-separated; default: all")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser->add_option("--poles", arguments->poles, "Number of poles, modes and hub zeros [5]");
  parser->add_option("--zeros", arguments->zeros,
                     "Number of zeros of each non-collocated sensor [4]");
  add_list_option(*parser, "--sensor", arguments->sensors,
                  "Sensors whose zeros are tracked [hub_angle,tip_acceleration]");
  parser->add_flag("--roots-only", arguments->roots_only,
                   "Skip hub slopes, end-point values and damping");
  parser
      ->add_option("--tolerance", arguments->tolerances.roots,
                   "Relative tolerance for poles and zeros")
      ->capture_default_str();
  parser->add_option("--threads", arguments->threads, "Maximum number of threads; 0: one per core")
      ->capture_default_str();
  add_verbose(*parser, arguments->verbose,
              "Print hub slopes, end-point values, models and the agreement of each quantity");
  parser->add_flag("--resume", arguments->resume,
                   "Resume an interrupted sweep from its checkpoint");
  add_output_choice(*parser, arguments->output, {"Folder for CSV tables and figures"});
  add_report_choice(*parser, arguments->report);
  parser->footer("Exit status: 0 the formulations agree; 1 they do not; 2 unusable input.\n" +
                 example("flexarm sweep rig.toml --over payload.mass=0:0.5:50 --out swept"));
  return {parser, [arguments] { return run_sweep(*arguments); }};
}

}  // namespace flexarm::app
