#include "app/command.hpp"
#include "app/folder_place.hpp"
#include "app/imported_run.hpp"
#include "app/run_choice.hpp"
#include "app/standard_output.hpp"
#include "app/starter_arm.hpp"
#include "app/word.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/range.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/record_export.hpp"
#include "measured/files/text_file.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/text_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  std::string file;
  ColumnChoice columns;
  std::string kind;
  std::optional<double> period_s;
  std::string arm_file;
  std::string folder;
  std::string name;
  std::string id;
  std::string purpose;
  std::string hold = "zero";
  std::string initial = "rest";
  std::optional<double> payload_mass_kg;
  std::optional<double> payload_inertia_kg_m2;
  bool force = false;
  std::string record_file;
  std::string record_format;
  std::string json_file;
};

/// How a record is written to a file of its own.
enum class RecordFormat { csv, uff58, uff58b, mat };

RecordFormat record_format(const ImportArguments& arguments) {
  const std::array<std::pair<const char*, RecordFormat>, 4> formats = {
      {{"csv", RecordFormat::csv},
       {"uff58", RecordFormat::uff58},
       {"uff58b", RecordFormat::uff58b},
       {"mat", RecordFormat::mat}}};
  std::string word = arguments.record_format;
  const std::string extension = fs::path(arguments.record_file).extension().string();
  if (word.empty()) {
    const bool is_universal = extension == ".uff" || extension == ".unv";
    word = is_universal ? "uff58" : extension.substr(extension.empty() ? 0 : 1);
  }
  std::vector<std::string> words;
  for (const auto& [name, format] : formats) {
    if (word == name) return format;
    words.emplace_back(name);
  }
  throw arm::InputError(fmt::format(
      "{} {}: must be {}{}", arguments.record_format.empty() ? "--save-as" : "--to",
      arm::shown(arguments.record_format.empty() ? arguments.record_file : arguments.record_format),
      arguments.record_format.empty() ? "a .csv, .uff or .mat file, or used with --to " : "",
      fmt::join(words, " or ")));
}

std::string csv_text(const measured::RunData& data) {
  if (const auto* time = std::get_if<measured::TimeRecord>(&data)) {
    return measured::format_time_record(*time);
  }
  if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
    return measured::format_frequency_record(*frequency);
  }
  return measured::format_modal_table(std::get<measured::ModalTable>(data));
}

void write_record(const measured::RunData& data, const fs::path& path, RecordFormat format) {
  if (format == RecordFormat::csv) {
    measured::write_atomically(path, csv_text(data));
    return;
  }
  const auto write = [&](const auto& record) {
    if (format == RecordFormat::mat) {
      measured::write_mat_file(measured::mat_variables(record), path);
    } else {
      measured::write_universal_file(measured::universal_functions(record), path,
                                     {.binary = format == RecordFormat::uff58b});
    }
  };
  if (const auto* time = std::get_if<measured::TimeRecord>(&data)) {
    write(*time);
  } else if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
    write(*frequency);
  } else {
    throw arm::InputError("--save-as: a modal table is written as CSV only");
  }
}

report::Table column_table(const ImportedRun& run) {
  report::Table table{"", {{"quantity"}, {"column"}, {"unit"}, {"scale"}}};
  for (const auto& [quantity, mapping] : run.columns) {
    table.add_row({quantity, mapping.name, mapping.unit, mapping.scale});
  }
  return table;
}

/// "10000 samples, every 0.002 s, 4 sensors".
std::string size_of(const measured::RunData& data) {
  const auto counted = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  if (const auto* time = std::get_if<measured::TimeRecord>(&data)) {
    return fmt::format("{}, one every {:.6g} s, of {}", counted(time->time_s.size(), "sample"),
                       measured::sampling_period_s(*time),
                       counted(time->channels.size(), "sensor") + " and the torque");
  }
  if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
    std::vector<std::string> parts;
    for (const auto& channel : frequency->channels) {
      parts.push_back(fmt::format("{} at {} from {:g} to {:g} Hz", arm::to_string(channel.sensor),
                                  counted(channel.frequency_Hz.size(), "frequency"),
                                  channel.frequency_Hz.front(), channel.frequency_Hz.back()));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
  }
  return counted(std::get<measured::ModalTable>(data).size(), "row");
}

void print_results(const ImportArguments& arguments, const ImportedRun& run) {
  print(report::to_paragraph(fmt::format("{}: {}, read as {}", arm::shown(arguments.file),
                                         to_string(run.format), to_string(run.kind))));
  for (const auto& sentence : run.assumptions) print(report::to_paragraph("  " + sentence, 4));
  if (!run.columns.empty()) print("\n" + report::to_text(column_table(run)) + "\n");
  if (!run.not_used.empty()) {
    print(report::to_paragraph(
        arm::shown(fmt::format("not used: {}", fmt::join(run.not_used, ", ")), 2000), 4));
  }
  print(report::to_paragraph(size_of(run.data), 4));
}

measured::Run planned_run(const ImportArguments& arguments) {
  measured::Run run;
  run.id = arguments.id.empty() ? id_of_file(arguments.file) : require_id(arguments.id);
  run.file = run.id + ".csv";
  if (!arguments.purpose.empty()) run.purpose = read_purpose(arguments.purpose);
  run.torque_hold = read_word("--hold", arguments.hold,
                              std::array{measured::TorqueHold::zero, measured::TorqueHold::first});
  run.initial = read_word("--initial", arguments.initial,
                          std::array{measured::InitialState::rest, measured::InitialState::free});
  if (arguments.payload_mass_kg || arguments.payload_inertia_kg_m2) {
    const double mass_kg = arguments.payload_mass_kg.value_or(0.0);
    const double inertia_kg_m2 = arguments.payload_inertia_kg_m2.value_or(0.0);
    arm::require_in_range("--payload-mass", mass_kg, "kg", arm::kNotNegative);
    arm::require_in_range("--payload-inertia", inertia_kg_m2, "kg m^2", arm::kNotNegative);
    run.payload = arm::Payload{mass_kg, inertia_kg_m2};
  }
  return run;
}

/// The arm file as it stands, comments and all, once it is known to be one.
std::string arm_text(const ImportArguments& arguments) {
  if (arguments.arm_file.empty()) return starter_text();
  constexpr std::size_t kLargestArm_bytes = 1 << 20;
  arm::require_valid(measured::read_arm_file(arguments.arm_file, effects::vocabulary()));
  return measured::read_text_file(arguments.arm_file, kLargestArm_bytes);
}

std::string json_text(const ImportArguments& arguments, const ImportedRun& run) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const auto& [quantity, mapping] : run.columns) {
    columns.push_back({{"quantity", quantity},
                       {"name", mapping.name},
                       {"unit", mapping.unit},
                       {"scale", mapping.scale}});
  }
  return report::json_document("flexarm.import/1", {{"file", arguments.file},
                                                    {"format", to_string(run.format)},
                                                    {"kind", to_string(run.kind)},
                                                    {"assumptions", run.assumptions},
                                                    {"columns", columns},
                                                    {"not_used", run.not_used}});
}

int run_import(const ImportArguments& arguments) {
  std::optional<measured::RunKind> kind;
  if (!arguments.kind.empty()) {
    kind = read_word(
        "--kind", arguments.kind,
        std::array{measured::RunKind::time, measured::RunKind::frf, measured::RunKind::modal});
  }
  measured::Run planned = planned_run(arguments);
  std::optional<RecordFormat> format;
  if (!arguments.record_file.empty()) format = record_format(arguments);
  if (!format && !arguments.record_format.empty()) {
    throw arm::InputError("--to: needs --save-as");
  }
  for (const auto& [option, file] : {std::pair{"--json", &arguments.json_file},
                                     std::pair{"--save-as", &arguments.record_file}}) {
    if (!file->empty() && fs::weakly_canonical(*file) == fs::weakly_canonical(arguments.file)) {
      throw arm::InputError(fmt::format("{} {}: is the input file", option, arm::shown(*file)));
    }
  }
  if (arguments.folder.empty()) {
    if (arguments.force) throw arm::InputError("--force: needs --out FOLDER");
    if (!arguments.name.empty()) throw arm::InputError("--name: needs --out FOLDER");
  } else {
    require_place(arguments.folder, arguments.force, measurement_folder_kind());
  }
  const std::string arm = arm_text(arguments);

  const ImportedRun imported =
      import_run(arguments.file, kind, arguments.columns, arguments.period_s);
  planned.kind = imported.kind;
  print_results(arguments, imported);
  if (!arguments.folder.empty()) {
    const std::string name = arguments.name.empty() ? planned.id : arguments.name;
    const measured::Measurement measurement{name, "arm.toml", {planned}};
    const std::vector<measured::NamedContent> files = {
        {planned.file, csv_text(imported.data)},
        {"arm.toml", arm},
        {"measurement.toml", measured::format_measurement(measurement)}};
    measured::write_folder_atomically(
        arguments.folder, files,
        arguments.force ? measured::IfExists::replace : measured::IfExists::refuse);
  }
  if (format) write_record(imported.data, arguments.record_file, *format);
  if (!arguments.json_file.empty()) {
    measured::write_atomically(arguments.json_file, json_text(arguments, imported));
  }
  if (format) print(fmt::format("wrote {}\n", arm::shown(arguments.record_file)));
  if (arguments.folder.empty()) {
    print(fmt::format("next: write it as a measurement with  flexarm import {} --out measured\n",
                      arm::shown(arguments.file)));
  } else {
    print(fmt::format(
        "wrote {0}: measurement.toml, arm.toml{1} and {2}\n"
        "next: {3}flexarm modes {0}/arm.toml\n",
        arguments.folder, arguments.arm_file.empty() ? " (template to edit)" : "", planned.file,
        arguments.arm_file.empty() ? "edit the arm file, then  " : "modes of the arm with  "));
  }
  return kSuccess;
}

void add_run_options(CLI::App& parser, ImportArguments& arguments) {
  parser.add_option("--kind", arguments.kind, "Content: time, frf or modal; default: detected");
  parser.add_option("--period", arguments.period_s,
                    "Sampling period [s] of a file without a time column");
  parser.add_option("--id", arguments.id, "Run id; default: file name");
  parser.add_option("--purpose", arguments.purpose, "Purpose of the run: estimation or validation");
  parser
      .add_option("--hold", arguments.hold,
                  "Torque between samples: zero (zero-order hold) or first (first-order hold)")
      ->capture_default_str();
  parser.add_option("--initial", arguments.initial, "Initial state: rest or free (unknown)")
      ->capture_default_str();
  parser.add_option("--payload-mass", arguments.payload_mass_kg,
                    "Payload mass [kg] of the run instead of that of the arm");
  parser.add_option("--payload-inertia", arguments.payload_inertia_kg_m2,
                    "Payload inertia about its centre of mass [kg m^2] of the run");
}

}  // namespace

Command add_import(CLI::App& program) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* parser = program.add_subcommand(
      "import", "Convert a log file (text, universal file, MATLAB) to a measurement");
  parser->add_option("FILE", arguments->file, "Input file")->required()->check(not_empty());
  add_column_choice(*parser, arguments->columns);
  add_run_options(*parser, *arguments);
  parser->add_option("--arm", arguments->arm_file, "Arm file; default: a template to edit")
      ->check(not_empty());
  parser->add_option("--name", arguments->name, "Name of the measurement");
  parser
      ->add_option("--out", arguments->folder,
                   "Folder for measurement.toml, arm.toml and the run as CSV in SI units")
      ->check(not_empty());
  parser->add_flag("--force", arguments->force, "Overwrite the measurement in the folder");
  parser
      ->add_option("--save-as", arguments->record_file,
                   "File for the run only: .csv, .uff (universal file) or .mat")
      ->check(not_empty());
  parser->add_option(
      "--to", arguments->record_format,
      "Format of that file: csv, uff58, uff58b (binary) or mat; default: by its extension");
  parser->add_option("--json", arguments->json_file, "JSON file: content and assumptions")
      ->check(not_empty());
  parser->footer(example("flexarm import simulated/bang-bang.csv --save-as bang-bang.uff"));
  return {parser, [arguments] { return run_import(*arguments); }};
}

}  // namespace flexarm::app
