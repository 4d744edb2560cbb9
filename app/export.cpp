#include "app/command.hpp"
#include "app/exported_arm.hpp"
#include "app/sensor_choice.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "export/fmu/fmu_export.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/tables/text_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string file;
  bool fmu = false;
  int fmi = 2;
  std::string out;
  fmu::FmuSettings settings;
  std::vector<std::string> sensors;
};

/// The FMU's file, beside nothing: in the present folder unless --out says otherwise.
fs::path fmu_file(const ExportArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path(arguments.file).stem().string() + ".fmu";
}

fmu::FmuRequest request_of(const ExportArguments& arguments) {
  if (arguments.fmi != 2 && arguments.fmi != 3) {
    throw arm::out_of_range("--fmi", arguments.fmi, "", "2 (FMI 2.0) or 3 (FMI 3.0)");
  }
  arm::require_in_range("--period", arguments.settings.sample_time_s, "s", arm::kPositive);
  if (arguments.settings.modes < 1) {
    throw arm::out_of_range("--modes", arguments.settings.modes, "", "1 or more");
  }
  ExportedArm exported = read_exported_arm(arguments.file);
  fmu::FmuRequest request{
      .arm = std::move(exported.arm),
      .settings = arguments.settings,
      .version = arguments.fmi == 2 ? fmu::FmiVersion::v2 : fmu::FmiVersion::v3,
      .model_identifier = fmu::identifier_of(fmu_file(arguments).stem().string()),
      .standard_deviations = std::move(exported.standard_deviations)};
  SensorChoice choice;
  choice.names = arguments.sensors;
  for (const ChosenSensor& chosen : choice.sensors(request.arm)) {
    request.settings.sensors.push_back(chosen.sensor);
  }
  return request;
}

report::Table variable_table(const fmu::FmuDescription& description) {
  report::Table table{"Variables of the FMU",
                      {{"variable"}, {"causality"}, {"start"}, {"standard deviation"}, {"unit"}}};
  for (const fmu::FmuVariable& variable : description.variables) {
    const bool is_parameter = variable.causality == fmu::Causality::parameter;
    if (variable.causality == fmu::Causality::independent) continue;
    const auto deviation = description.standard_deviations.find(variable.name);
    table.add_row({variable.name, std::string(fmu::word_for(variable.causality)),
                   is_parameter ? fmt::format("{:.6g}", variable.start) : std::string(),
                   deviation == description.standard_deviations.end()
                       ? std::string()
                       : fmt::format("{:.2g}", deviation->second),
                   variable.unit});
  }
  return table;
}

int run_export(const ExportArguments& arguments) {
  if (!arguments.fmu) throw arm::InputError("export: needs --fmu");
  const fs::path file = fmu_file(arguments);
  const auto request = request_of(arguments);
  measured::require_writable(file);
  const fmu::Fmu made = fmu::make_fmu(request);
  measured::write_atomically(file, made.archive);
  print(report::to_text(variable_table(made.description)) + "\n");
  print(fmt::format("wrote {}: FMI {}.0 for co-simulation, {:.1f} MB\n", file.string(),
                    arguments.fmi, static_cast<double>(made.archive.size()) * 1e-6));
  print(fmt::format("next: the same responses with  flexarm simulate {} --period {}\n",
                    arguments.file, request.settings.sample_time_s));
  return kSuccess;
}

}  // namespace

Command add_export(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  auto& settings = arguments->settings;
  CLI::App* parser = program.add_subcommand(
      "export", "Export an arm for other tools: as an FMU for co-simulation");
  parser
      ->add_option("FILE", arguments->file,
                   "Arm file, or the JSON of a diagnosis: its extended arm, with the standard "
                   "errors of the identified effects")
      ->required()
      ->check(not_empty());
  parser->add_flag("--fmu", arguments->fmu, "Write an FMU for co-simulation");
  parser
      ->add_option("--out", arguments->out,
                   "File of the FMU; default: the name of FILE with .fmu, in the present folder")
      ->check(not_empty());
  parser->add_option("--fmi", arguments->fmi, "Version of the FMI standard: 2 (2.0) or 3 (3.0)")
      ->capture_default_str();
  parser->add_option("--formulation", settings.formulation, "exact_tf, fem or assumed_modes")
      ->capture_default_str();
  parser->add_option("--modes", settings.modes, "Number of flexible modes")->capture_default_str();
  parser->add_flag("--static-correction", settings.static_correction,
                   "Add a residual mode for omitted modes");
  parser
      ->add_option("--sensor", arguments->sensors,
                   "Outputs, comma-separated; default: hub_angle, hub_velocity and, with a beam, "
                   "tip_acceleration")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser
      ->add_option("--period", settings.sample_time_s,
                   "Inner step [s]: multiples of it are the best communication steps")
      ->capture_default_str();
  parser->footer(example("flexarm export --fmu diagnosis/extended.toml --out arm.fmu"));
  return {parser, [arguments] { return run_export(*arguments); }};
}

}  // namespace flexarm::app
