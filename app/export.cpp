#include "app/command.hpp"
#include "app/exported_arm.hpp"
#include "app/exported_files.hpp"
#include "app/option_values.hpp"
#include "app/screen.hpp"
#include "app/sensor_choice.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "experiment/run_choice.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/text_table.hpp"
#include "report/tables/truncation_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

constexpr int kMostSamples = 100'000;
/// The matrices of a step take 0.1 GB each then, and their exponential minutes.
constexpr int kMostModes = 2000;
/// An FMU is stepped in real time, and its matrices are made again for each communication step that
/// is new.
constexpr int kMostChosenFmuModes = 40;

struct ExportArguments {
  std::string file;
  bool fmu = false;
  std::optional<int> fmi;
  std::string out;
  std::string state_space_file;
  std::optional<int> samples;
  std::optional<std::uint64_t> seed;
  bool modes_alone = false;
  std::string formulation = "exact_tf";
  std::optional<int> modes;
  bool static_correction = false;
  std::vector<std::string> sensors;
  std::optional<double> period_s;
  std::string json_file;
};

template <class T>
void refuse_without(const char* option, const std::optional<T>& value, bool is_needed,
                    const char* needed) {
  if (value && !is_needed) throw arm::InputError(fmt::format("{}: needs {}", option, needed));
}

/// Throws for what does not go together, or could not be written: before the work.
void prepare(const ExportArguments& arguments) {
  const bool state_space = !arguments.state_space_file.empty();
  if (!arguments.fmu && !state_space) {
    throw arm::InputError("export: needs --fmu, or --state-space FILE");
  }
  refuse_without("--fmi", arguments.fmi, arguments.fmu, "--fmu");
  refuse_without("--period", arguments.period_s, arguments.fmu, "--fmu");
  refuse_without("--samples", arguments.samples, state_space, "--state-space FILE");
  refuse_without("--seed", arguments.seed, state_space, "--state-space FILE");
  const auto flag = [](bool given) { return given ? std::optional(true) : std::nullopt; };
  refuse_without("--out", flag(!arguments.out.empty()), arguments.fmu, "--fmu");
  refuse_without("--static-correction", flag(arguments.static_correction), arguments.fmu, "--fmu");
  refuse_without("--modes-alone", flag(arguments.modes_alone), state_space, "--state-space FILE");
  if (const int fmi = arguments.fmi.value_or(2); fmi != 2 && fmi != 3) {
    throw arm::out_of_range("--fmi", fmi, "", "2 (FMI 2.0) or 3 (FMI 3.0)");
  }
  if (arguments.period_s) {
    arm::require_in_range("--period", *arguments.period_s, "s", arm::kPositive);
  }
  if (const int modes = arguments.modes.value_or(1); modes < 1 || modes > kMostModes) {
    throw arm::out_of_range("--modes", modes, "", fmt::format("1 to {}", kMostModes));
  }
  if (const int samples = arguments.samples.value_or(0); samples < 0 || samples > kMostSamples) {
    throw arm::out_of_range("--samples", samples, "", fmt::format("0 to {}", kMostSamples));
  }
  if (state_space) require_samples_file(arguments.state_space_file);
  if (!arguments.json_file.empty()) measured::require_writable(arguments.json_file);
}

/// In the present folder unless --out says otherwise.
fs::path fmu_file(const ExportArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path(arguments.file).stem().string() + ".fmu";
}

std::vector<arm::Sensor> sensors_of(const ExportArguments& arguments, const arm::Arm& arm) {
  SensorChoice choice;
  choice.names = arguments.sensors;
  std::vector<arm::Sensor> made;
  for (const ChosenSensor& chosen : choice.sensors(arm)) made.push_back(chosen.sensor);
  return made;
}

/// Truncation of an FMU, whose torque is not known: as of `flexarm simulate` by its default
/// excitation.
response::Truncation fmu_truncation(const arm::Arm& arm, const fmu::FmuSettings& settings,
                                    std::optional<int> modes) {
  const auto samples = static_cast<std::size_t>(
      std::max(std::round(experiment::kDefaultDuration_s / settings.sample_time_s), 2.0));
  response::BangBang pulses;
  pulses.pulse_s = std::max(pulses.pulse_s, settings.sample_time_s);
  const auto torque =
      sample(pulses, {std::min(samples, response::kMostJudgedSamples), settings.sample_time_s});
  return response::truncation_in_time(
      arm, settings.sensors, torque.torque_N_m, settings.sample_time_s, response::TorqueHold::zero,
      {modes, std::min(kMostChosenFmuModes, response::most_chosen_modes(settings.formulation))});
}

std::string export_fmu(const ExportArguments& arguments, const ExportedArm& exported,
                       nlohmann::ordered_json& json) {
  const fs::path file = fmu_file(arguments);
  measured::require_writable(file);
  const int fmi = arguments.fmi.value_or(2);
  fmu::FmuRequest request{.arm = exported.arm,
                          .settings = {.formulation = arguments.formulation,
                                       .static_correction = arguments.static_correction,
                                       .sensors = sensors_of(arguments, exported.arm)},
                          .version = fmi == 2 ? fmu::FmiVersion::v2 : fmu::FmiVersion::v3,
                          .model_identifier = fmu::identifier_of(file.stem().string()),
                          .standard_deviations = exported.standard_deviations()};
  if (arguments.period_s) request.settings.sample_time_s = *arguments.period_s;
  const auto truncation = fmu_truncation(exported.arm, request.settings, arguments.modes);
  request.settings.modes = truncation.modes;
  const fmu::Fmu made = fmu::make_fmu(request);
  measured::write_atomically(file, made.archive);
  json = fmu_json(made.description, fmi, file.string());
  json["truncation"] = report::truncation_json(truncation, request.settings.sensors);
  return report::to_text(fmu_table(made.description)) +
         screen_paragraph(report::truncation_sentence(truncation, request.settings.sensors)) +
         fmt::format("\nwrote {}: FMI {}.0 for co-simulation, inner step {} s, {:.1f} MB\n",
                     file.string(), fmi, request.settings.sample_time_s,
                     static_cast<double>(made.archive.size()) * 1e-6);
}

std::string export_state_space(const ExportArguments& arguments, const ExportedArm& exported,
                               nlohmann::ordered_json& json) {
  const samples::StateSpaceSettings settings{.formulation = arguments.formulation,
                                             .modes = arguments.modes,
                                             .static_correction = !arguments.modes_alone,
                                             .sensors = sensors_of(arguments, exported.arm)};
  const auto made = sample_state_spaces(exported.posterior, settings, arguments.samples.value_or(0),
                                        arguments.seed.value_or(1));
  write_samples(made, arguments.state_space_file);
  json = samples_summary_json(made, arguments.state_space_file);
  const auto& truncation = made.state_space.truncation;
  json["truncation"] = report::truncation_json(truncation, settings.sensors);
  return samples_text(made) +
         screen_paragraph(report::truncation_sentence(truncation, settings.sensors)) +
         fmt::format("wrote {}: {} states, {} sensors, the nominal arm and {} samples\n",
                     arguments.state_space_file, made.state_space.states.size(),
                     settings.sensors.size(), made.samples.samples.size() - 1);
}

/// The number of flexible modes of the state space, or of the FMU where there is none.
nlohmann::ordered_json modes_of(const nlohmann::ordered_json& fmu,
                                const nlohmann::ordered_json& state_space) {
  return (state_space.is_null() ? fmu : state_space)["truncation"]["modes"];
}

int run_export(const ExportArguments& arguments) {
  prepare(arguments);
  const ExportedArm exported = read_exported_arm(arguments.file);
  nlohmann::ordered_json fmu = nullptr;
  nlohmann::ordered_json state_space = nullptr;
  std::string text;
  if (arguments.fmu) text += export_fmu(arguments, exported, fmu);
  if (!arguments.state_space_file.empty()) {
    text += export_state_space(arguments, exported, state_space);
  }
  if (!arguments.json_file.empty()) {
    measured::write_atomically(
        arguments.json_file,
        report::json_document("flexarm.export/1", {{"arm", report::arm_json(exported.arm)},
                                                   {"model", arguments.formulation},
                                                   {"modes", modes_of(fmu, state_space)},
                                                   {"fmu", std::move(fmu)},
                                                   {"state_space", std::move(state_space)}}));
  }
  print(text);
  print(arguments.fmu
            ? fmt::format("next: state spaces with parameter samples with  flexarm export {} "
                          "--state-space samples.mat --samples 100\n",
                          arguments.file)
            : fmt::format("next: an FMU for co-simulation with  flexarm export --fmu {}\n",
                          arguments.file));
  return kSuccess;
}

}  // namespace

Command add_export(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* parser = program.add_subcommand(
      "export", "Export an arm: FMU for co-simulation, state spaces with parameter samples");
  parser
      ->add_option("FILE", arguments->file,
                   "Arm file, or the JSON of a diagnosis: its extended arm, with the posterior of "
                   "its effects and uncertain numbers")
      ->required()
      ->check(not_empty());
  parser->add_flag("--fmu", arguments->fmu, "Write an FMU for co-simulation");
  parser
      ->add_option("--out", arguments->out,
                   "File of the FMU; default: the name of FILE with .fmu, in the present folder")
      ->type_name(kFileType)
      ->check(not_empty());
  parser->add_option("--fmi", arguments->fmi,
                     "Version of the FMI standard: 2 (2.0, default) or 3 (3.0)");
  parser->add_option("--period", arguments->period_s,
                     "Inner step of the FMU [s], default 0.0005; communication steps that are "
                     "multiples of it are the fastest");
  parser->add_flag("--static-correction", arguments->static_correction,
                   "FMU: add a residual mode for omitted modes");
  parser
      ->add_option(
          "--state-space", arguments->state_space_file,
          "File for A, B, C, D of the nominal arm and of samples: .json or .mat (MATLAB 5)")
      ->check(not_empty());
  parser->add_option("--samples", arguments->samples,
                     "Number of samples of the uncertain numbers; default 0");
  parser->add_option("--seed", arguments->seed, "Seed of the samples; default 1");
  parser->add_flag("--modes-alone", arguments->modes_alone,
                   "State space without static correction for omitted modes");
  parser->add_option("--formulation", arguments->formulation, "exact_tf, fem or assumed_modes")
      ->capture_default_str();
  parser->add_option(
      "--modes", arguments->modes,
      "Number of flexible modes; default: as many as keep the truncation error of "
      "each sensor below 1e-4 (FMU: under the default torque of flexarm simulate, 40 "
      "at most; state space: to above the fifth pole, 160 at most)");
  parser
      ->add_option("--sensor", arguments->sensors,
                   "Outputs, comma-separated; default: hub_angle, hub_velocity and, with a beam, "
                   "tip_acceleration")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser->add_option("--json", arguments->json_file, "JSON file, full precision")
      ->check(not_empty());
  parser->footer(example("flexarm export --fmu rig.toml --out arm.fmu"));
  return {parser, [arguments] { return run_export(*arguments); }};
}

}  // namespace flexarm::app
