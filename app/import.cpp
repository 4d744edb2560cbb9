#include "app/command.hpp"
#include "app/folder_place.hpp"
#include "app/import_options.hpp"
#include "app/import_report.hpp"
#include "app/json_file.hpp"
#include "app/record_format.hpp"
#include "app/standard_output.hpp"
#include "app/starter_arm.hpp"
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "importing/import_request.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/text_file.hpp"
#include "report/progress.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  importing::ImportRequest request;
  std::string arm_file;
  std::string folder;
  std::string name;
  bool force = false;
  std::string record_file;
  std::string record_format;
  std::string json_file;
};

/// The arm file as it stands, comments and all, once it is known to be one.
std::string arm_text(const ImportArguments& arguments) {
  if (arguments.arm_file.empty()) return unfilled_text();
  constexpr std::size_t kLargestArm_bytes = 1 << 20;
  arm::require_valid(measured::read_arm_file(arguments.arm_file, effects::vocabulary()));
  return measured::read_text_file(arguments.arm_file, kLargestArm_bytes);
}

void require_consistent(const ImportArguments& arguments) {
  if (arguments.record_file.empty() && !arguments.record_format.empty()) {
    throw arm::InputError("--to: needs --save-as");
  }
  if (arguments.folder.empty()) {
    if (arguments.force) throw arm::InputError("--force: needs --out FOLDER");
    if (!arguments.name.empty()) throw arm::InputError("--name: needs --out FOLDER");
  } else {
    require_place(arguments.folder, arguments.force, measurement_folder_kind());
  }
}

void write_measurement(const ImportArguments& arguments,
                       const std::vector<importing::ImportedRun>& runs, const std::string& arm) {
  measured::Measurement measurement{arguments.name, "arm.toml", {}};
  if (measurement.name.empty() && runs.size() == 1) measurement.name = runs.front().run.id;
  if (measurement.name.empty()) {
    measurement.name = fs::weakly_canonical(arguments.folder).filename().string();
  }
  std::vector<measured::NamedContent> contents;
  for (const auto& run : runs) {
    measurement.runs.push_back(run.run);
    contents.push_back({run.run.file, measured::format_run_data(run.data)});
  }
  contents.push_back({"arm.toml", arm});
  contents.push_back({"measurement.toml", measured::format_measurement(measurement)});
  write_folder(arguments.folder, arguments.force, contents);
}

void print_next(const ImportArguments& arguments, const std::vector<importing::ImportedRun>& runs) {
  if (!arguments.record_file.empty()) {
    print(fmt::format("wrote {}\n", arm::shown(arguments.record_file)));
  }
  if (arguments.folder.empty()) {
    print(fmt::format("next: write it as a measurement with  flexarm import {} --out measured\n",
                      arm::shown(fmt::format("{}", fmt::join(arguments.request.files, " ")), 400)));
    return;
  }
  std::vector<std::string> names;
  for (const auto& run : runs) names.push_back(run.run.file);
  const bool has_arm = !arguments.arm_file.empty();
  print(fmt::format(
      "wrote {0}: measurement.toml, arm.toml{1} and {2}\nnext: {3}\n", arguments.folder,
      has_arm ? "" : " (its numbers are to be filled in)", fmt::join(names, ", "),
      has_arm ? fmt::format("compare simulation and measurement with  flexarm "
                            "diagnose {}/measurement.toml",
                            arguments.folder)
              : fmt::format("poles with  flexarm identify {0}/measurement.toml ; for all "
                            "else fill in {0}/arm.toml",
                            arguments.folder)));
}

int run_import(const ImportArguments& arguments) {
  const auto& request = arguments.request;
  importing::require_valid(request);
  std::optional<RecordFormat> format;
  if (!arguments.record_file.empty()) {
    format = record_format(arguments.record_file, arguments.record_format);
  }
  require_consistent(arguments);
  const std::string arm = arm_text(arguments);
  std::optional<report::Progress> progress;
  if (!request.join.is_wanted) {
    progress.emplace("reading files", static_cast<std::int64_t>(request.files.size()));
  }
  const auto [files, runs] = importing::import_logs(request, [&] { progress->advance(); });
  progress.reset();
  if (format && runs.size() > 1) {
    throw arm::InputError(
        fmt::format("--save-as: writes a single run; the input makes {}", runs.size()));
  }
  print(import_text(files, runs));
  if (!arguments.folder.empty()) write_measurement(arguments, runs, arm);
  if (format) write_record(runs.front().data, arguments.record_file, *format);
  write_json(arguments.json_file, import_json(files, runs));
  print_next(arguments, runs);
  return kSuccess;
}

void add_file_options(CLI::App& parser, ImportArguments& arguments) {
  parser.add_option("FILE", arguments.request.files, "Input files")->required()->check(not_empty());
  add_column_choice(parser, arguments.request.file.columns);
  parser
      .add_option("--controller", arguments.request.controller,
                  "Controller that made the torque of --reference: KEY=VALUE,... with sensor, kp, "
                  "kd, ki, derivative (error or measurement), limit [N m] and sample_time [s], or "
                  "a TOML file with these keys or A, B, C, D")
      ->check(not_empty());
  add_join_choice(parser, arguments.request.join);
  parser.add_option("--kind", arguments.request.kind,
                    "Content: time, frf or modal; default: detected");
  parser.add_option("--period", arguments.request.file.period_s,
                    "Sampling period [s] of a file without a time column");
  parser.add_option("--raw-columns", arguments.request.file.raw_columns,
                    "The file is nothing but doubles (64 bit, little endian), row by row, N "
                    "columns; assign them by number, e.g. --column torque=#2");
}

}  // namespace

Command add_import(CLI::App& program) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* parser = program.add_subcommand(
      "import", "Convert log files (text, universal file, MATLAB, JSON, doubles) to a measurement");
  add_file_options(*parser, *arguments);
  add_runs_choice(*parser, arguments->request.runs);
  parser
      ->add_option("--arm", arguments->arm_file,
                   "Arm file; default: a template whose numbers are to be filled in")
      ->check(not_empty());
  parser->add_option("--name", arguments->name, "Name of the measurement");
  parser
      ->add_option("--out", arguments->folder,
                   "Folder for measurement.toml, arm.toml and the runs as CSV in SI units")
      ->check(not_empty());
  parser->add_flag("--force", arguments->force, "Overwrite the measurement in the folder");
  parser
      ->add_option("--save-as", arguments->record_file,
                   "File for a single run only: .csv, .uff (universal file) or .mat")
      ->check(not_empty());
  parser->add_option(
      "--to", arguments->record_format,
      "Format of that file: csv, uff58, uff58b (binary) or mat; default: by its extension");
  parser
      ->add_option("--json", arguments->json_file,
                   "JSON file: content and assumptions; - for standard output")
      ->check(not_empty());
  parser->footer(
      example("flexarm import simulated/bang-bang.csv --reference reference "
              "--controller kp=0.2,kd=0.01 --out measured"));
  return {parser, [arguments] { return run_import(*arguments); }};
}

}  // namespace flexarm::app
