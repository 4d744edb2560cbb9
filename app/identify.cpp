#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/figure_choice.hpp"
#include "app/identified_files.hpp"
#include "app/json_file.hpp"
#include "app/kept_inputs.hpp"
#include "app/list_option.hpp"
#include "app/screen.hpp"
#include "app/spectrum_choice.hpp"
#include "app/standard_output.hpp"
#include "app/word.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/nearest_name.hpp"
#include "arm/range.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/identification.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/run_identification.hpp"
#include "report/json/arm_json.hpp"
#include "report/json/identification_json.hpp"
#include "report/json/json_document.hpp"
#include "report/progress.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/identified_overview.hpp"
#include "report/tables/identified_root_tables.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

struct IdentifyArguments {
  std::string file;
  std::vector<std::string> runs;
  std::vector<std::string> sensors;
  SpectrumChoice spectrum;
  std::string input;
  bool no_fit = false;
  std::optional<int> modes;
  std::optional<double> from_Hz;
  std::optional<double> to_Hz;
  int highest_order = 32;
  std::optional<double> total_inertia_kg_m2;
  std::string folder;
  bool force = false;
  FigureChoice figures;
  bool verbose = false;
  std::string json_file;
};

/// The runs asked for, all unless told. Throws InputError for one that there is not.
std::vector<measured::Run> chosen_runs(const IdentifyArguments& arguments,
                                       const measured::Measurement& measurement) {
  if (arguments.runs.empty()) return measurement.runs;
  std::vector<std::string> ids;
  for (const auto& run : measurement.runs) ids.push_back(run.id);
  std::vector<measured::Run> chosen;
  for (const auto& id : arguments.runs) {
    const auto at = std::ranges::find(measurement.runs, id, &measured::Run::id);
    if (at == measurement.runs.end()) {
      throw arm::InputError(fmt::format("--run {}: no such run in {}{}; its runs are {}",
                                        arm::shown(id), arguments.file, arm::did_you_mean(id, ids),
                                        fmt::join(ids, ", ")));
    }
    if (std::ranges::find(chosen, id, &measured::Run::id) != chosen.end()) {
      throw arm::InputError(fmt::format("--run {}: given twice", arm::shown(id)));
    }
    chosen.push_back(*at);
  }
  return chosen;
}

/// Leaves the sensors asked for in the data, all unless told. Throws InputError where none of the
/// runs has one.
void select_sensors(const IdentifyArguments& arguments, std::vector<measured::MeasuredRun>& runs) {
  std::vector<arm::Sensor> wanted;
  for (const auto& name : arguments.sensors) wanted.push_back(arm::parse_sensor(name));
  if (wanted.empty()) return;
  std::vector<bool> seen(wanted.size(), false);
  const auto unwanted = [&](const arm::Sensor& sensor) {
    const auto at = std::ranges::find(wanted, sensor);
    if (at == wanted.end()) return true;
    seen[static_cast<std::size_t>(at - wanted.begin())] = true;
    return false;
  };
  for (auto& run : runs) {
    if (auto* table = std::get_if<measured::ModalTable>(&run.data)) {
      std::erase_if(*table,
                    [&](const auto& entry) { return entry.sensor && unwanted(*entry.sensor); });
      continue;
    }
    std::visit(
        [&](auto& record) {
          if constexpr (requires { record.channels; }) {
            std::erase_if(record.channels,
                          [&](const auto& channel) { return unwanted(channel.sensor); });
          }
        },
        run.data);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!seen[i]) {
      throw arm::InputError(
          fmt::format("--sensor {}: not measured in any run", arguments.sensors[i]));
    }
  }
}

measured::IdentificationOptions options_of(const IdentifyArguments& arguments,
                                           const arm::Arm& arm) {
  measured::IdentificationOptions options;
  options.spectrum = arguments.spectrum.settings();
  options.peaks.place = arguments.spectrum.place();
  if (!arguments.input.empty()) {
    options.input = read_word("--input", arguments.input, measured::kResponseInputs);
  }
  if (arm::has_beam(arm)) options.check.length_m = arm::linear_arm(arm).length_m;
  options.check.total_inertia_kg_m2 = arm::total_inertia_kg_m2(arm);
  options.fit = !arguments.no_fit;
  if (arguments.modes && *arguments.modes < 1) {
    throw arm::out_of_range("--modes", *arguments.modes, "", "1 or more");
  }
  if (arguments.highest_order < 2 || arguments.highest_order > 100) {
    throw arm::out_of_range("--order", arguments.highest_order, "", "2 to 100");
  }
  if (arguments.total_inertia_kg_m2) {
    arm::require_in_range("--total-inertia", *arguments.total_inertia_kg_m2, "kg m^2",
                          arm::kPositive);
  }
  options.total_inertia_kg_m2 = arguments.total_inertia_kg_m2;
  options.modal_fit.modes = arguments.modes;
  options.modal_fit.highest_order = arguments.highest_order;
  options.modal_fit.rigid_body = arm::linear_arm(arm).turns_freely();
  if (arguments.from_Hz || arguments.to_Hz) {
    const double from_Hz = arguments.from_Hz.value_or(0.0);
    if (!(from_Hz >= 0.0)) throw arm::out_of_range("--from-Hz", from_Hz, "Hz", "0 or more");
    if (!arguments.to_Hz || !(*arguments.to_Hz > from_Hz)) {
      throw arm::InputError(fmt::format("--to-Hz: must be given, and above {:g} Hz", from_Hz));
    }
    options.modal_fit.band = {from_Hz, *arguments.to_Hz};
    options.peaks.from_Hz = from_Hz;
    options.peaks.to_Hz = *arguments.to_Hz;
  }
  return options;
}

measured::Identification identify_with_progress(std::vector<measured::MeasuredRun> runs,
                                                measured::IdentificationOptions options) {
  report::Progress progress("identifying");
  options.progress = [&](std::string_view, double fraction) {
    progress.reach(fraction);
    return true;
  };
  return measured::identify(std::move(runs), options);
}

std::string fit_text(const measured::RunsFit& fit, const measured::Identification& identification,
                     const compare::AnalyticalModes& analytical) {
  if (!fit.refusal.empty()) return "";
  const auto modes = std::ranges::count(fit.fit.poles, true, &measured::FittedPole::is_mode);
  const auto others = std::ssize(fit.fit.poles) - modes;
  std::string text = screen_paragraph(
      fmt::format("Modal fit of {}{}, {:.4g} to {:.4g} Hz: {} mode{}, {} other second-order "
                  "section{}; {}{}",
                  report::joined(report::ids_of(fit, identification)),
                  fit.hub_held       ? ", responses to the hub motion"
                  : fit.of_responses ? ", estimated responses"
                                     : "",
                  fit.fit.band.from_Hz, fit.fit.band.to_Hz, modes, modes == 1 ? "" : "s", others,
                  others == 1 ? "" : "s", fit.fit.order_reason,
                  fit.fit.converged ? "" : "; not converged"),
      2);
  if (fit.fit.robust_covariance) {
    text += screen_paragraph(
        "  Residuals are not white: standard errors are robust (sandwich) estimates.", 2);
  }
  if (fit.fit.delay_s > 0.0) {
    text += screen_paragraph(
        fmt::format("  Common delay or lag of {:.3g} ms indicated by the residues. Poles are "
                    "unaffected; zeros, slopes and gains are biased.",
                    1e3 * fit.fit.delay_s),
        2);
  }
  text += "\n" + screen_table(report::residual_table(fit));
  return text + screen_table(report::gain_table(fit, analytical), 4);
}

/// Empty where there is one payload.
std::string payload_heading(const compare::IdentifiedCondition& condition, std::size_t conditions) {
  if (conditions == 1) return "";
  return fmt::format("Payload {:g} kg, {:g} kg m^2\n\n", condition.payload.mass_kg,
                     condition.payload.inertia_kg_m2);
}

/// The settings of the spectra, the roots by every method and sensor, and the fits.
std::string details_text(const measured::Identification& identification,
                         const std::vector<compare::IdentifiedCondition>& conditions) {
  std::string text;
  for (const auto& run : identification.runs) {
    if (!run.estimate) continue;
    text += fmt::format("{}: spectra and frequency responses\n", run.run.id);
    for (const auto& line : report::setting_lines(run)) text += screen_paragraph("  " + line, 4);
    text += "\n";
  }
  for (const auto& condition : conditions) {
    text += payload_heading(condition, conditions.size());
    for (const auto& runs : report::sources(identification, condition)) {
      const report::IdentifiedData data{identification, condition, runs};
      for (const auto& table : {report::pole_table(data), report::held_pole_table(data),
                                report::zero_table(data), report::damping_table(data)}) {
        text += screen_table(table, 2);
      }
    }
    for (const std::size_t f : condition.fits) {
      text += fit_text(identification.fits[f], identification, condition.analytical);
    }
  }
  return text;
}

/// The roots, each by its best method, and what the data or the estimates fall short of.
std::string results_text(const measured::Identification& identification,
                         const std::vector<compare::IdentifiedCondition>& conditions) {
  std::string text;
  for (const auto& condition : conditions) {
    text += payload_heading(condition, conditions.size());
    for (const auto& runs : report::sources(identification, condition)) {
      const report::IdentifiedData data{identification, condition, runs};
      text += screen_table(report::identified_overview(data), 2);
      text += screen_table(report::real_zero_table(data));
    }
  }
  if (text.empty()) text = "No pole or zero was identified.\n\n";
  for (const auto& run : identification.runs) {
    text += screen_table(report::distortion_table(run));
  }
  const auto notes = report::data_notes(identification);
  for (const auto& note : notes) text += screen_note(note);
  return notes.empty() ? text : text + "\n";
}

/// Throws for outputs that could not be written, or would take the place of what is read: before
/// the work, not after it.
void prepare(const IdentifyArguments& arguments, const measured::Measurement& measurement) {
  if (arguments.force && arguments.folder.empty()) {
    throw arm::InputError("--force: needs --out FOLDER");
  }
  const auto inputs = measured::files_of(arguments.file, measurement);
  if (!arguments.json_file.empty()) require_no_input("--json", arguments.json_file, inputs);
  if (!arguments.folder.empty()) require_no_input("--out", arguments.folder, inputs);
  arguments.figures.require_valid(arguments.folder);
  require_json_place(arguments.json_file, arguments.folder);
  if (arguments.folder.empty()) return;
  require_place(arguments.folder, arguments.force, identified_folder_kind());
}

void write_files(const IdentifyArguments& arguments, const std::string& measurement,
                 const arm::Arm& arm, const measured::Identification& identification,
                 const std::vector<compare::IdentifiedCondition>& conditions) {
  if (arguments.folder.empty() && arguments.json_file.empty()) return;
  nlohmann::ordered_json document = {{"measurement", measurement}, {"arm", report::arm_json(arm)}};
  document.update(report::identification_json(identification, conditions));
  const std::string json = report::json_document("flexarm.identify/1", document);
  if (!arguments.folder.empty()) {
    auto files = identified_files(identification, conditions, arguments.figures.options());
    files.push_back({kIdentifiedJson, json});
    write_folder(arguments.folder, arguments.force, files);
  }
  write_json(arguments.json_file, json);
}

int run_identify(const IdentifyArguments& arguments) {
  const measured::Measurement measurement = measured::read_measurement(arguments.file);
  const fs::path arm_file = measured::beside(arguments.file, measurement.arm);
  const arm::Arm arm = measured::read_arm_file(arm_file, effects::vocabulary());
  arm::require_valid(arm);
  const auto options = options_of(arguments, arm);
  std::vector<measured::MeasuredRun> runs;
  for (const auto& run : chosen_runs(arguments, measurement)) {
    runs.push_back({run, measured::read_run(arguments.file, run)});
  }
  select_sensors(arguments, runs);
  prepare(arguments, measurement);

  const auto identification = identify_with_progress(std::move(runs), options);
  const auto conditions = compare::conditions_of(identification, arm);
  std::string text = results_text(identification, conditions);
  text += describe(arm) + left_out_of_roots(arm) + "\n";
  if (arguments.verbose) text += details_text(identification, conditions);
  try {
    write_files(arguments, measurement.name, arm, identification, conditions);
  } catch (const arm::InputError&) {
    print(text);
    throw;
  }
  if (!arguments.verbose) {
    text +=
        "details: settings of the spectra with reasons, every method and sensor, gains, "
        "residuals with  --verbose\n";
  }
  if (arguments.folder.empty()) {
    text += fmt::format(
        "next: write figures and modal tables with  flexarm identify {} --out identified\n",
        arm::shown(arguments.file));
  } else {
    text += fmt::format("wrote {}\n", arguments.folder);
  }
  print(text);
  return kSuccess;
}

}  // namespace

Command add_identify(CLI::App& program) {
  const auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* parser = program.add_subcommand(
      "identify",
      "Estimate spectra, poles, zeros, damping, hub slopes and gains from measured data");
  parser->add_option("FILE", arguments->file, "measurement.toml")->required()->check(not_empty());
  parser->add_option("--run", arguments->runs, "Run ids, comma-separated; default: all")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_list_option(*parser, "--sensor", arguments->sensors,
                  "Sensors, comma-separated; default: all");
  add_spectrum_choice(*parser, arguments->spectrum);
  parser->add_option("--input", arguments->input,
                     "Input of the responses of time runs: torque, hub_angle or hub_velocity; "
                     "default: torque, hub motion where the torque is unusable");
  parser->add_option("--from-Hz", arguments->from_Hz, "Lowest frequency of peaks and fits");
  parser->add_option("--to-Hz", arguments->to_Hz,
                     "Highest frequency; default: where the torque has power");
  parser->add_option("--modes", arguments->modes,
                     "Number of flexible second-order sections; default: by BIC");
  parser
      ->add_option("--order", arguments->highest_order, "Highest order of the stabilisation chart")
      ->capture_default_str();
  parser->add_option("--total-inertia", arguments->total_inertia_kg_m2,
                     "Total inertia I_T [kg m^2] for slopes and gains; default: estimated from the "
                     "rigid-body mode");
  parser->add_flag("--no-fit", arguments->no_fit, "Spectra, peaks and circle fits only");
  add_verbose(*parser, arguments->verbose,
              "Print settings with reasons, every method and sensor, gains and residuals");
  parser
      ->add_option("--out", arguments->folder,
                   "New folder for modal tables, responses (CSV), figures and JSON")
      ->check(not_empty());
  parser->add_flag("--force", arguments->force, "Overwrite a folder written by this command");
  add_figure_choice(*parser, arguments->figures);
  parser
      ->add_option("--json", arguments->json_file,
                   "JSON file, full precision; - for standard output")
      ->check(not_empty());
  parser->footer(example("flexarm identify simulated/measurement.toml --out identified"));
  return {parser, [arguments] { return run_identify(*arguments); }};
}

}  // namespace flexarm::app
