#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/formulation_choice.hpp"
#include "app/json_file.hpp"
#include "app/list_option.hpp"
#include "app/output_choice.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "app/state_space_file.hpp"
#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/response_plots.hpp"
#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/json/response_json.hpp"
#include "report/progress.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/modes_report.hpp"
#include "report/tables/response_tables.hpp"
#include "report/tables/truncation_text.hpp"
#include "response/frequency/response_study.hpp"
#include "response/settings.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// A matrix of so many modes takes 0.8 GB.
constexpr int kMostModes = 10000;
constexpr std::size_t kPrintedFrequencies = 12;
constexpr std::size_t kVerboseFrequencies = 25;

struct ResponseArguments {
  ArmChoice arm;
  FormulationChoice formulation;
  std::vector<std::string> sensors;  ///< empty: hub angle and, with a beam, tip acceleration
  response::ResponseOptions options;
  std::string state_space_file;
  bool modes_alone = false;
  std::optional<int> modes;
  bool verbose = false;
  OutputChoice output;
};

/// The options as the library takes them. Throws InputError for what is wrong in itself.
response::ResponseOptions options_of(const ResponseArguments& arguments) {
  response::ResponseOptions options = arguments.options;
  options.modes = arguments.modes.value_or(options.modes);
  options.state_space_modes = arguments.modes;
  if (options.modes < 1) throw arm::out_of_range("--modes", options.modes, "", "1 or more");
  if (options.modes > kMostModes) {
    throw arm::out_of_range(
        "--modes", options.modes, "",
        fmt::format("at most {} (the damping between all pairs of modes is kept)", kMostModes));
  }
  for (const auto& name : arguments.sensors) options.sensors.push_back(arm::parse_sensor(name));
  const bool grid = options.from_Hz || options.to_Hz;
  if (!options.frequency_Hz.empty()) {
    if (grid) throw arm::InputError("--frequencies: not together with --from-Hz or --to-Hz");
    response::require_ascending(options.frequency_Hz, "--frequencies");
  }
  if (options.from_Hz && !(*options.from_Hz > 0.0)) {
    throw arm::out_of_range("--from-Hz", *options.from_Hz, "Hz", "above 0");
  }
  if (options.to_Hz && !(*options.to_Hz > options.from_Hz.value_or(0.0))) {
    throw arm::out_of_range("--to-Hz", *options.to_Hz, "Hz",
                            fmt::format("above {} Hz", options.from_Hz.value_or(0.0)));
  }
  if (options.points < 2 || options.points > response::kMostFrequencies) {
    throw arm::out_of_range("--points", options.points, "",
                            fmt::format("2 to {}", response::kMostFrequencies));
  }
  options.state_space = !arguments.state_space_file.empty();
  options.static_correction = !arguments.modes_alone;
  if (arguments.modes_alone && !options.state_space) {
    throw arm::InputError("--modes-alone: needs --state-space FILE");
  }
  return options;
}

/// Fine enough for the modes and for the highest frequency.
ChosenFormulation make_formulation(const ResponseArguments& arguments, const arm::Arm& arm,
                                   const response::ResponseOptions& options) {
  const int roots = response::roots_needed(arm, options);
  const bool discrete = arguments.formulation.name != "exact_tf";
  if (discrete && roots > response::kMostRoots && options.modes < response::kMostRoots) {
    throw arm::InputError(fmt::format(
        "{}: about {} roots lie below the highest frequency; {} has at most {}, exact_tf has no "
        "limit",
        !options.frequency_Hz.empty() ? "--frequencies"
        : options.to_Hz               ? "--to-Hz"
                                      : "--modes",
        roots, arguments.formulation.name, response::kMostRoots));
  }
  return arguments.formulation.make(arm, roots);
}

/// The response as a product over poles and zeros and as a sum over modes.
std::string forms_text(const response::ResponseStudy& study) {
  std::string text;
  for (std::size_t k = 0; k < study.response.sensors.size(); ++k) {
    auto factors = report::factors_table(study, k);
    text += screen_paragraph(factors.caption);
    factors.caption.clear();
    for (const auto& formula : report::formulas(study, k)) {
      text += screen_paragraph("  " + formula, 4);
    }
    text += screen_table(factors);
  }
  return text;
}

std::string study_text(const response::ResponseStudy& study,
                       const response::ResponseOptions& options, bool verbose) {
  std::string text;
  const auto notes = report::chain_notes(study);
  for (const auto& note : notes) text += screen_paragraph(note, 2);
  if (!notes.empty()) text += "\n";
  const auto frequencies = study.response.frequency_Hz.size();
  const bool listed = !options.frequency_Hz.empty();
  auto table = report::response_table(study.response, listed    ? 0
                                                      : verbose ? kVerboseFrequencies
                                                                : kPrintedFrequencies);
  table.caption =
      table.rows.size() == frequencies
          ? fmt::format("Frequency response at {} frequencies", frequencies)
          : fmt::format("Frequency response at {} of {} frequencies (all with --out and --json)",
                        table.rows.size(), frequencies);
  text += screen_table(table);
  text += screen_rows(report::response_poles_table(study, static_cast<std::size_t>(options.modes)),
                      verbose ? kAllRows : kScreenRows, "--verbose, --out or --json");
  if (verbose) text += forms_text(study);
  if (study.state_space) {
    text += screen_table(report::state_space_table(study));
    text +=
        screen_paragraph(report::truncation_sentence(*study.truncation, study.response.sensors));
  }
  return text;
}

FolderKind response_folder_kind() {
  return {"a frequency response",
          {"response.csv"},
          {".csv", ".svg", ".pdf", ".png", ".json", ".mat"},
          true};
}

/// The files of one arm, in `folder` of the output folder.
void add_files(const fs::path& folder, const std::string& formulation,
               const response::ResponseStudy& study, const FigureChoice& figures,
               std::vector<measured::NamedContent>& files) {
  const auto write_csv = [&](const std::string& name, const report::Table& table) {
    files.push_back({folder / name, report::to_csv(table)});
  };
  write_csv("poles.csv", report::response_poles_table(study, study.poles.omega_rad_per_s.size()));
  write_csv("response.csv", report::response_listing(study.response));
  write_csv("frf.csv", report::frf_listing(study.response));
  for (std::size_t k = 0; k < study.response.sensors.size(); ++k) {
    write_csv(fmt::format("factors-{}.csv", arm::to_string(study.response.sensors[k])),
              report::factors_table(study, k));
  }
  figures.add_to(files, folder,
                 report::response_plots(formulation, study, figures.nyquist_marks()));
}

std::string next_step(const ResponseArguments& arguments) {
  const std::string arm = arguments.arm.file.empty() ? "" : " " + arguments.arm.file;
  std::string lines = details_line(arguments.verbose, "factored and modal form");
  if (!arguments.state_space_file.empty()) {
    lines += fmt::format("wrote {}\n", arguments.state_space_file);
  }
  const bool drawn = !arguments.output.folder.empty();
  if (drawn) lines += fmt::format("wrote {}\n", arguments.output.folder);
  if (drawn && !arguments.state_space_file.empty()) {
    return lines +
           fmt::format("next: compare the three formulations with  flexarm compare{}\n", arm);
  }
  if (drawn) {
    return lines +
           fmt::format(
               "next: export a state-space model with  flexarm response{} --state-space arm.mat\n",
               arm);
  }
  return lines +
         fmt::format(
             "next: write Bode and Nyquist diagrams with  flexarm response{} --out response\n",
             arm);
}

response::ResponseStudy study_with_progress(const arm::Arm& arm,
                                            const response::AnyFormulation& formulation,
                                            response::ResponseOptions options) {
  report::Progress progress("computing frequency response");
  options.progress = [&progress](double fraction) { progress.reach(fraction); };
  return response::study_response(arm, formulation, options);
}

int run_response(const ResponseArguments& arguments) {
  auto options = options_of(arguments);
  const auto arms = arguments.arm.arms();
  if (options.sensors.empty()) {
    options.sensors = {{arm::SensorKind::hub_angle}};
    if (arm::has_beam(arms.front())) options.sensors.push_back({arm::SensorKind::tip_acceleration});
  }
  for (const auto& arm : arms) {
    for (const auto& sensor : options.sensors) arm::require_responsive(sensor, arm);
  }
  if (options.state_space) {
    require_state_space_file(arguments.state_space_file);
    if (arms.size() > 1) {
      throw arm::InputError("--state-space: needs one arm; --payload-mass has several values");
    }
  }
  arguments.output.prepare(response_folder_kind());
  std::vector<measured::NamedContent> files;
  std::optional<response::ResponseStudy> with_state_space;

  std::string text;  // printed last: a reader that goes away costs no file
  nlohmann::ordered_json documents = nlohmann::ordered_json::array();
  for (const auto& arm : arms) {
    const auto chosen = make_formulation(arguments, arm, options);
    const auto study = study_with_progress(arm, chosen.formulation, options);
    const report::Progress forming("forming tables");
    text += describe(arm);
    text += fmt::format("by {}\n\n", response::formulation_label(chosen.name, chosen.settings));
    text += study_text(study, options, arguments.verbose);

    nlohmann::ordered_json document = {
        {"arm", report::arm_json(arm)}, {"model", chosen.name}, {"settings", chosen.settings}};
    document.update(report::response_json(study));
    documents.push_back(std::move(document));
    if (options.state_space) with_state_space = study;
    if (!arguments.output.folder.empty()) {
      add_files(folder_of("", arm, arms.size()), chosen.name, study, arguments.output.figures,
                files);
      if (std::ranges::all_of(study.resonances, &std::vector<response::Resonance>::empty)) {
        text += "no Nyquist diagrams: no damped pole in the frequency range\n";
      }
    }
  }
  {
    const report::Progress writing("writing files");
    if (!files.empty()) write_folder(arguments.output.folder, arguments.output.force, files);
    if (with_state_space) write_state_space(*with_state_space, arguments.state_space_file);
    if (!arguments.output.json_file.empty()) {
      write_json(arguments.output.json_file,
                 report::json_document("flexarm.response/1", {{"arms", documents}}));
    }
  }
  text += next_step(arguments);
  print(text);
  return kSuccess;
}

}  // namespace

Command add_response(CLI::App& program) {
  const auto arguments = std::make_shared<ResponseArguments>();
  auto& options = arguments->options;
  CLI::App* parser = program.add_subcommand(
      "response",
      "Compute frequency response, factored and modal forms, and state space of an arm");
  add_arm_choice(*parser, arguments->arm);
  add_formulation_choice(*parser, arguments->formulation);
  add_list_option(*parser, "--sensor", arguments->sensors,
                  "Sensors, comma-separated; default: hub_angle and, with a beam, "
                  "tip_acceleration");
  parser->add_option("--from-Hz", options.from_Hz,
                     "Lowest frequency; default: well below the first pole");
  parser->add_option("--to-Hz", options.to_Hz,
                     "Highest frequency; default: above the last of the --modes poles");
  parser
      ->add_option("--points", options.points,
                   "Number of logarithmic frequencies; refined at poles and zeros")
      ->capture_default_str();
  add_list_option(*parser, "--frequencies", options.frequency_Hz,
                  "Frequencies [Hz] instead of a range, comma-separated");
  parser->add_option(
      "--modes", arguments->modes,
      "Number of poles, of zeros per sensor, and of flexible modes of the state space; "
      "default: 5 poles, and modes for a truncation error of 1e-4 in the range");
  parser
      ->add_option(
          "--state-space", arguments->state_space_file,
          "File for A, B, C, D and their frequency response: .json, .csv or .mat (MATLAB 5)")
      ->check(not_empty());
  parser->add_flag("--modes-alone", arguments->modes_alone,
                   "State space without static correction for omitted modes");
  add_verbose(*parser, arguments->verbose,
              "Print the response as a product over poles and zeros and as a sum over modes");
  add_output_choice(*parser, arguments->output,
                    {"Folder for CSV tables, Bode and Nyquist diagrams"});
  parser->footer(example("flexarm response rig.toml --sensor hub_angle,strain@0.05 --to-Hz 200"));
  return {parser, [arguments] { return run_response(*arguments); }};
}

}  // namespace flexarm::app
