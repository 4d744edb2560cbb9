#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/folder_place.hpp"
#include "app/formulation_choice.hpp"
#include "app/json_file.hpp"
#include "app/memory_need.hpp"
#include "app/output_choice.hpp"
#include "app/run_choice.hpp"
#include "app/screen.hpp"
#include "app/sensor_choice.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "experiment/simulated_experiment.hpp"
#include "report/json/simulation_json.hpp"
#include "report/measurement_folder.hpp"
#include "report/progress.hpp"
#include "report/tables/simulation_report.hpp"
#include "report/tables/stepped_sine_report.hpp"
#include "report/tables/truncation_text.hpp"
#include "response/settings.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

struct SimulateArguments {
  ArmChoice arm;
  RunChoice runs;
  SensorChoice sensors;
  experiment::ExperimentOptions options;
  std::string hold = "zero";
  std::vector<std::string> hidden_effects;
  std::string name;
  OutputChoice output;
  bool verbose = false;
};

response::TorqueHold read_hold(const std::string& word) {
  if (word == "zero") return response::TorqueHold::zero;
  if (word == "first") return response::TorqueHold::first;
  throw arm::InputError(fmt::format(
      "--hold {}: must be zero (zero-order hold) or first (first-order hold)", arm::shown(word)));
}

/// The arm of the runs, without the payloads that --payload-mass gives them.
arm::Arm base_arm(const ArmChoice& choice) {
  ArmChoice base = choice;
  base.payload_masses_kg.clear();
  return base.arms().front();
}

void refuse_without_folder(const char* option, bool given) {
  if (given) throw arm::InputError(fmt::format("{}: needs --out FOLDER", option));
}

/// Throws for outputs that could not be written: before the work, not after it.
void prepare(const SimulateArguments& arguments) {
  if (arguments.output.folder.empty()) {
    refuse_without_folder("--hide-effects", !arguments.hidden_effects.empty());
    refuse_without_folder("--name", !arguments.name.empty());
  }
  arguments.output.prepare(measurement_folder_kind());
}

/// With a line of progress on standard error for each run.
experiment::SimulatedExperiment simulate_with_progress(
    const arm::Arm& arm, const std::vector<PlannedRun>& plan,
    const std::vector<ChosenSensor>& sensors, const experiment::ExperimentOptions& options) {
  const auto line_of = [](const std::string& label, std::size_t total) {
    const auto line = std::make_shared<report::Progress>(label, static_cast<std::int64_t>(total));
    return [line](double fraction) {
      line->reach(fraction);
      return true;
    };
  };
  return experiment::simulate_experiment(arm, plan, sensors, options, line_of);
}

/// The numbers of excitations that samples could not take as they were typed.
std::string rounding_notes(const std::vector<PlannedRun>& plan) {
  std::string notes;
  for (const auto& run : plan) {
    std::vector<std::string> changes;
    for (const auto& [name, unit, typed, taken] : run.rounded) {
      changes.push_back(fmt::format("{} {} {} is {} {}", name, typed, unit, taken, unit));
    }
    if (changes.empty()) continue;
    notes += screen_note(
        fmt::format("{}: {}: rounded to whole samples", run.id, fmt::join(changes, ", ")));
  }
  return notes;
}

/// Which runs are of an arm that does not stay where it is.
std::string standing_notes(const std::vector<report::SimulatedRun>& runs) {
  std::string notes;
  for (const auto& run : runs) {
    if (run.fall_rate_rad_per_s == 0.0) continue;
    notes += screen_note(
        fmt::format("{}: statically unstable (inverted) arm: undamped poles at s = +-{:.6g} "
                    "rad/s; the equations hold for small angles only",
                    run.id, run.fall_rate_rad_per_s));
  }
  return notes;
}

/// What the longest sampling period does not show of the modes that are seen in the readings.
std::string sampling_note(const arm::Arm& arm, const experiment::SimulatedExperiment& experiment) {
  const double highest_Hz = experiment.truncation.visible_Hz;
  double longest_s = 0.0;
  for (const auto& run : experiment.runs) {
    longest_s = std::max(longest_s, measured::sampling_period_s(run.record));
  }
  const double samples = 1.0 / (highest_Hz * longest_s);
  if (!(samples < response::kFineSamplesPerPeriod)) return "";
  const double fine_s = 1.0 / (highest_Hz * response::kFineSamplesPerPeriod);
  const double digit_s = std::pow(10.0, std::floor(std::log10(fine_s)));
  // Without damping more modes are visible the finer the sampling.
  const std::string advice =
      arm::linear_arm(arm).kelvin_voigt_s > 0.0
          ? fmt::format("a sampling period (--period) of {:.1g} s shows all of it",
                        digit_s * std::floor(fine_s / digit_s))
          : "the arm has no material damping, and high modes do not decay: state "
            "damping.kelvin_voigt in its file";
  return screen_note(fmt::format(
      "modes up to {:.3g} Hz are visible in the readings (1 % of a signal). The highest has {:.2g} "
      "samples per period: {}. The readings are exact; {}.",
      highest_Hz, samples,
      samples <= response::kAliasedSamplesPerPeriod ? "they show it at a lower frequency (alias)"
                                                    : "its peaks fall between them",
      advice));
}

/// Stepped sines that were not steady when they were measured.
std::string settling_notes(const std::vector<report::SteppedSineRun>& runs) {
  std::string notes;
  for (const auto& run : runs) {
    const auto& summary = run.measured.summary;
    if (summary.unsettled == 0) continue;
    notes += screen_note(
        fmt::format("{}: at {} of {} frequencies the response changed by more than {:g} "
                    "between the first and the last measured cycle (largest change {:.2g} at {} "
                    "Hz): remaining transient, or a motion that is not periodic with the sine",
                    run.id, summary.unsettled, run.measured.frequency_Hz.size(),
                    response::kSettledChange, summary.largest_change, summary.largest_change_Hz));
  }
  return notes;
}

/// The largest residual of the energy balances, relative to the work.
std::string energy_line(const std::vector<report::SimulatedRun>& runs) {
  double residual = 0.0;
  for (const auto& run : runs) {
    residual =
        std::max(residual, std::abs(report::relative_energy_residual(run.simulation.energy)));
  }
  return screen_paragraph(
      fmt::format("Energy balance: largest residual {:.1e} of the work of the torque.", residual));
}

/// A table whose last column says in a sentence what excites each run: the sentences below it.
std::string with_sentences_below(report::Table table) {
  std::string sentences;
  for (auto& row : table.rows) {
    sentences += screen_paragraph(fmt::format("{}: {}", std::get<std::string>(row.front()),
                                              std::get<std::string>(row.back())),
                                  2);
    row.pop_back();
  }
  table.columns.pop_back();
  return screen_table(table) + sentences + "\n";
}

void print_runs_in_time(const std::vector<report::SimulatedRun>& runs, bool has_dry_friction,
                        bool verbose) {
  if (runs.empty()) return;
  print(screen_table(report::reading_table(runs), 2));
  if (has_dry_friction) print(screen_table(report::hub_motion_table(runs)));
  print(with_sentences_below(report::torque_table(runs)));
  print(verbose ? screen_table(report::energy_table(runs)) : energy_line(runs) + "\n");
}

void print_stepped_runs(const std::vector<report::SteppedSineRun>& runs, bool has_dry_friction) {
  if (runs.empty()) return;
  print(screen_table(report::stepped_response_table(runs), 2));
  if (has_dry_friction) print(screen_table(report::stepped_hub_motion_table(runs)));
  print(with_sentences_below(report::stepped_sine_table(runs)));
}

void print_results(const SimulateArguments& arguments, const arm::Arm& arm,
                   const std::vector<PlannedRun>& plan,
                   const experiment::SimulatedExperiment& experiment) {
  const bool has_dry_friction = !response::take_apart(arm).hub.friction.empty();
  const auto& runs = experiment.runs;
  print_runs_in_time(runs, has_dry_friction, arguments.verbose);
  print_stepped_runs(experiment.stepped_runs, has_dry_friction);
  const std::string notes = rounding_notes(plan) + standing_notes(runs) +
                            sampling_note(arm, experiment) +
                            settling_notes(experiment.stepped_runs);
  if (!notes.empty()) print(notes + "\n");
}

/// The arm and the model that it was simulated with.
void print_model(const SimulateArguments& arguments, const arm::Arm& arm,
                 const experiment::SimulatedExperiment& experiment) {
  const char* hold =
      arguments.options.hold == response::TorqueHold::zero ? "zero-order hold" : "first-order hold";
  print(describe(arm));
  print(screen_paragraph(fmt::format(
      "by {}, {} flexible mode{}{}{}",
      response::formulation_label(experiment.model, experiment.settings), experiment.modes,
      experiment.modes == 1 ? "" : "s",
      arguments.options.static_correction ? " and a residual mode" : "",
      experiment.runs.empty() ? ""
                              : fmt::format("; {} of the torque, initial state at rest", hold))));
  const auto& truncation = experiment.truncation;
  print(screen_paragraph(report::truncation_sentence(truncation, experiment.sensors)));
  if (experiment.modes < arguments.options.modes.value_or(0)) {
    print(screen_note(fmt::format("{} of {} modes: {} has {} degrees of freedom", experiment.modes,
                                  *arguments.options.modes, experiment.model,
                                  experiment.degrees_of_freedom)));
  }
  print("\n");
}

/// Lower estimates: of what a million samples take (700 MB, measured), and of the matrices of a
/// step.
void require_memory_for(const experiment::ExperimentOptions& options,
                        const std::vector<PlannedRun>& plan) {
  constexpr double kSampleBytes = 400.0;
  constexpr double kMatrices = 3.0;
  double samples = 0.0;
  for (const auto& run : plan) samples += static_cast<double>(run.time_s.size());
  require_memory("samples of all runs", samples, kSampleBytes * samples);
  if (!options.modes) return;
  const double states = 2.0 * *options.modes;
  require_memory("--modes", *options.modes, kMatrices * sizeof(double) * states * states);
}

/// `written` is what the folder says of the arm.
void write_files(const SimulateArguments& arguments, const arm::Arm& arm, const arm::Arm& written,
                 const std::vector<PlannedRun>& plan,
                 const experiment::SimulatedExperiment& experiment) {
  const report::Progress writing("writing files");
  if (!arguments.output.folder.empty()) {
    const std::string name = arguments.name.empty() ? report::simulated_name(arm) : arguments.name;
    write_folder(arguments.output.folder, arguments.output.force,
                 report::measurement_folder(name, written, plan, experiment, arguments.options.hold,
                                            arguments.output.figures.options()));
  }
  if (arguments.output.json_file.empty()) return;
  write_json(arguments.output.json_file,
             report::simulation_document(arm, experiment, arguments.options));
}

int run_simulate(SimulateArguments arguments) {
  auto& options = arguments.options;
  options.hold = read_hold(arguments.hold);
  options.noise_seed = arguments.runs.seed;
  const arm::Arm arm = base_arm(arguments.arm);
  const arm::Arm written =
      experiment::with_hidden_effects(arm, arguments.hidden_effects, "--hide-effects");
  const auto sensors = arguments.sensors.sensors(arm);
  const auto plan = arguments.runs.runs(arm, arguments.arm.payload_masses_kg);
  experiment::require_valid(options, plan, sensors, arm::on_command_line);
  require_memory_for(options, plan);
  prepare(arguments);

  const auto experiment = simulate_with_progress(arm, plan, sensors, options);
  // Files first: a reader of standard output that goes away costs none of them.
  write_files(arguments, arm, written, plan, experiment);
  print_model(arguments, arm, experiment);
  print_results(arguments, arm, plan, experiment);
  if (arguments.output.folder.empty()) {
    print(fmt::format("next: write it as a measurement with  flexarm simulate{} --out simulated\n",
                      arguments.arm.file.empty() ? "" : " " + arguments.arm.file));
  } else {
    print(fmt::format(
        "wrote {}: measurement.toml, arm.toml, and a CSV file and figures for each run\n",
        arguments.output.folder));
    print(experiment.stepped_runs.empty()
              ? fmt::format(
                    "next: frequency response of the same arm with  flexarm response {}/arm.toml\n",
                    arguments.output.folder)
              : fmt::format("next: estimate poles, zeros and damping with  flexarm identify "
                            "{}/measurement.toml\n",
                            arguments.output.folder));
  }
  return kSuccess;
}

}  // namespace

Command add_simulate(CLI::App& program) {
  const auto arguments = std::make_shared<SimulateArguments>();
  auto& options = arguments->options;
  CLI::App* parser = program.add_subcommand(
      "simulate", "Simulate time responses of an arm and write them as a measurement");
  add_arm_choice(*parser, arguments->arm);
  add_run_choice(*parser, arguments->runs);
  parser
      ->add_option("--hold", arguments->hold,
                   "Torque between samples: zero (zero-order hold) or first (first-order hold)")
      ->capture_default_str();
  add_formulation_choice(*parser, options.formulation);
  parser->add_option("--modes", options.modes,
                     "Number of flexible modes; default: as many as keep the truncation error of "
                     "each sensor below 1e-4 of its signal");
  parser->add_flag(
      "--static-correction", options.static_correction,
      "Add a residual mode for omitted modes; not added by default: torque steps excite it "
      "(docs/numerics.md)");
  add_sensor_choice(*parser, arguments->sensors);
  parser->add_option("--substeps", options.substeps,
                     "Minimum number of inner steps per sample; default: automatic");
  parser->add_flag("--check-step", options.check_step,
                   "Report the error of each sensor relative to a step ten times smaller");
  parser
      ->add_option("--hide-effects", arguments->hidden_effects,
                   "Effects to omit from the written arm file, comma-separated, or all: for blind "
                   "tests of a diagnosis")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_verbose(*parser, arguments->verbose,
              "Print the parameters of each excitation and the energy balance");
  parser->add_option("--name", arguments->name, "Name of the measurement");
  add_output_choice(
      *parser, arguments->output,
      {.folder = "Folder for measurement.toml, arm.toml, and a CSV file and figures for each run",
       .force = "Overwrite the measurement in the folder"});
  parser->footer(
      example("flexarm simulate rig.toml --excitation bang-bang:amplitude=0.2,pulse=0.4 "
              "--excitation multisine:rms=0.03,to=60 --noise 0.005 --out measured"));
  return {parser, [arguments] { return run_simulate(*arguments); }};
}

}  // namespace flexarm::app
