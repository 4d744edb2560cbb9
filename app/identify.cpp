#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/identified_files.hpp"
#include "app/json_file.hpp"
#include "app/list_option.hpp"
#include "app/output_choice.hpp"
#include "app/report_choice.hpp"
#include "app/screen.hpp"
#include "app/spectrum_choice.hpp"
#include "app/standard_output.hpp"
#include "app/time_limit.hpp"
#include "arm/input_error.hpp"
#include "arm/time_limit.hpp"
#include "compare/identification.hpp"
#include "compare/identification_task.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/run_identification.hpp"
#include "report/json/identification_json.hpp"
#include "report/page/identify_page.hpp"
#include "report/progress.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/identified_overview.hpp"
#include "report/tables/identified_root_tables.hpp"
#include "report/tables/method_differences.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::app {

namespace {

struct IdentifyArguments {
  std::string file;
  compare::IdentificationRequest request;
  bool no_fit = false;
  std::optional<double> time_limit_s = {};
  OutputChoice output;
  bool verbose = false;
  ReportChoice report;
};

measured::Identification identify_with_progress(const std::string& file,
                                                std::vector<measured::MeasuredRun> runs,
                                                measured::IdentificationOptions options) {
  report::Progress progress("identifying");
  options.progress = [&](std::string_view, double fraction) {
    progress.reach(fraction);
    return true;
  };
  try {
    return measured::identify(std::move(runs), options);
  } catch (const arm::InputError& error) {
    throw arm::located(error, file, 0);
  }
}

std::string fit_text(const measured::RunsFit& fit, const measured::Identification& identification,
                     const compare::IdentifiedCondition& condition) {
  if (!fit.refusal.empty()) return "";
  const auto modes = std::ranges::count(fit.fit.poles, true, &measured::FittedPole::is_mode);
  const auto others = std::ssize(fit.fit.poles) - modes;
  std::string text = screen_paragraph(
      fmt::format("Modal fit of {}{}, {:.4g} to {:.4g} Hz: {} mode{}, {} other second-order "
                  "section{}; {}{}",
                  report::joined(report::ids_of(fit, identification)),
                  fit.fit.free_decay ? ", free decay"
                  : fit.hub_held     ? ", responses to the hub motion"
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
  return text + screen_table(report::gain_table(fit, condition), 4);
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
      text += fit_text(identification.fits[f], identification, condition);
    }
  }
  return text;
}

/// The doubts about the fits, the roots, each by its best method, and notes on data and estimates.
std::string results_text(const measured::Identification& identification,
                         const std::vector<compare::IdentifiedCondition>& conditions) {
  std::string text;
  for (const auto& doubt : report::doubts(identification)) {
    text += screen_paragraph("Doubtful: " + doubt, 2);
  }
  if (!text.empty()) text += "\n";
  const std::size_t doubts_end = text.size();
  for (const auto& condition : conditions) {
    text += payload_heading(condition, conditions.size());
    for (const auto& runs : report::sources(identification, condition)) {
      const report::IdentifiedData data{identification, condition, runs};
      text += screen_table(report::identified_poles_overview(data));
      text += screen_table(report::identified_zeros_overview(data), 2);
      text += screen_table(report::real_zero_table(data));
    }
  }
  if (text.size() == doubts_end) text += "No pole or zero was identified.\n\n";
  for (const auto& run : identification.runs) {
    text += screen_table(report::distortion_table(run));
  }
  auto notes = report::data_notes(identification);
  std::ranges::move(report::all_method_differences(identification, conditions),
                    std::back_inserter(notes));
  for (const auto& note : notes) text += screen_note(note);
  return notes.empty() ? text : text + "\n";
}

/// Throws for outputs that could not be written, or would take the place of what is read: before
/// the work, not after it.
void prepare(const IdentifyArguments& arguments, const measured::Measurement& measurement) {
  const auto inputs = measured::files_of(arguments.file, measurement);
  arguments.output.prepare(identified_folder_kind(), inputs);
  arguments.report.prepare(arguments.output.folder, inputs);
}

void write_files(const IdentifyArguments& arguments, const std::string& measurement,
                 const std::optional<arm::Arm>& arm, const measured::Identification& identification,
                 const std::vector<compare::IdentifiedCondition>& conditions) {
  if (arguments.output.folder.empty() && arguments.output.json_file.empty()) return;
  const std::string json =
      report::identification_document(measurement, arm, identification, conditions);
  if (!arguments.output.folder.empty()) {
    auto files = identified_files(identification, conditions, arguments.output.figures.options());
    files.push_back({kIdentifiedJson, json});
    write_folder(arguments.output.folder, arguments.output.force, files);
  }
  write_json(arguments.output.json_file, json);
}

int run_identify(const IdentifyArguments& arguments) {
  const arm::Deadline deadline = arm::deadline_of(
      arguments.time_limit_s, std::chrono::steady_clock::now(), arm::on_command_line);
  auto request = arguments.request;
  request.fit = !arguments.no_fit;
  auto task = compare::read_identification_task(arguments.file, request);
  task.options.deadline = deadline;
  prepare(arguments, task.measurement);
  std::vector<measured::MeasuredRun> recorded;  // the report shows them
  if (arguments.report.is_given()) recorded = task.runs;

  const auto identification =
      identify_with_progress(arguments.file, std::move(task.runs), task.options);
  const auto conditions = compare::conditions_of(identification, task.arm);
  std::string text = results_text(identification, conditions);
  text += task.arm ? describe(*task.arm) + left_out_of_roots(*task.arm)
                   : screen_note(fmt::format(
                         "{}: poles and zeros are counted from 1 up, and nothing "
                         "is compared with a prediction",
                         task.measurement.arm.empty()
                             ? "the measurement states no arm"
                             : "no number is filled in in " + arm::shown(task.measurement.arm)));
  text += "\n";
  if (arguments.verbose) text += details_text(identification, conditions);
  try {
    write_files(arguments, task.measurement.name, task.arm, identification, conditions);
    if (arguments.report.is_given()) {
      arguments.report.write(report::page::identify_page(identification, conditions, recorded,
                                                         page_origin(arguments.file)));
    }
  } catch (const arm::InputError&) {
    print(text);
    throw;
  }
  text += details_line(arguments.verbose,
                       "settings with reasons, every method and sensor, gains, residuals");
  if (arguments.output.folder.empty()) {
    text += fmt::format(
        "next: write figures and modal tables with  flexarm identify {} --out identified\n",
        arm::shown(arguments.file));
  } else {
    text += fmt::format("wrote {}\n", arguments.output.folder);
  }
  text += arguments.report.last_line();
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
  parser->add_option("--run", arguments->request.runs, "Run ids, comma-separated; default: all")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_list_option(*parser, "--sensor", arguments->request.sensors,
                  "Sensors, comma-separated; default: all");
  add_spectrum_choice(*parser, arguments->request.spectrum);
  parser->add_option("--input", arguments->request.input,
                     "Input of the responses of time runs: torque, hub_angle or hub_velocity; "
                     "default: torque, hub motion where the torque is unusable");
  parser->add_option("--from-Hz", arguments->request.from_Hz, "Lowest frequency of peaks and fits");
  parser->add_option("--to-Hz", arguments->request.to_Hz,
                     "Highest frequency; default: where the torque has power");
  parser->add_option("--modes", arguments->request.modes,
                     "Number of flexible second-order sections; default: by BIC");
  parser
      ->add_option("--order", arguments->request.highest_order,
                   "Highest order of the stabilisation chart")
      ->capture_default_str();
  parser->add_option("--total-inertia", arguments->request.total_inertia_kg_m2,
                     "Total inertia I_T [kg m^2] for slopes and gains; default: estimated from the "
                     "rigid-body mode");
  parser->add_flag("--no-fit", arguments->no_fit, "Spectra, peaks and circle fits only");
  add_time_limit(*parser, arguments->time_limit_s);
  add_verbose(*parser, arguments->verbose,
              "Print settings with reasons, every method and sensor, gains and residuals");
  add_output_choice(*parser, arguments->output,
                    {"New folder for modal tables, responses (CSV), figures and JSON"});
  add_report_choice(*parser, arguments->report);
  parser->footer(example("flexarm identify simulated/measurement.toml --out identified"));
  return {parser, [arguments] { return run_identify(*arguments); }};
}

}  // namespace flexarm::app
