#include "app/arm_choice.hpp"
#include "app/command.hpp"
#include "app/formulation_choice.hpp"
#include "app/json_file.hpp"
#include "app/list_option.hpp"
#include "app/memory_need.hpp"
#include "app/output_choice.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/shapes.hpp"
#include "exact_tf/certificate.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/progress.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/modes_report.hpp"
#include "response/settings.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// Rows that are printed of each table.
constexpr std::size_t kModesRows = 30;

struct ModesArguments {
  ArmChoice arm;
  FormulationChoice formulation;
  int count = 5;
  std::vector<std::string> sensors = {"hub_angle", "tip_acceleration"};
  bool certificate = false;
  bool verbose = false;
  OutputChoice output;
};

/// One list of roots that ball arithmetic was asked about.
struct CertifiedList {
  std::string roots;  ///< "poles", "zeros of hub_angle"
  exact_tf::Certificate certificate;
};

/// Certificates of the poles and of every sensor's zeros, as exact_tf gives them.
std::vector<CertifiedList> certify(const arm::Arm& arm, const std::vector<arm::Sensor>& sensors,
                                   int count) {
  const exact_tf::ExactArm exact(arm);
  std::vector<CertifiedList> lists;
  lists.push_back({"poles", exact_tf::certify_poles(arm, exact.pole_lambdas(count))});
  for (const auto& sensor : sensors) {
    lists.push_back(
        {"zeros of " + arm::to_string(sensor),
         arm::is_collocated(sensor)
             ? exact_tf::certify_hub_zeros(arm, exact.hub_zero_lambdas(count))
             : exact_tf::certify_zeros(arm, sensor, exact.zeros(sensor, count).s_rad_per_s)});
  }
  return lists;
}

/// A line for each list that is shorter than was asked for, and why.
std::string shortfalls(const ChosenFormulation& chosen, const response::ModalSummary& summary,
                       int count) {
  std::string lines;
  if (std::ssize(summary.modes) < count) {
    lines += fmt::format("{} of {} modes: {} has {} degrees of freedom\n", summary.modes.size(),
                         count, chosen.name, response::degrees_of_freedom(chosen.formulation));
  }
  for (const auto& [sensor, zeros] : summary.zeros) {
    if (std::ssize(zeros.s_rad_per_s) == count) continue;
    lines +=
        fmt::format("{} of {} zeros of {} found; {} spurious roots rejected\n",
                    zeros.s_rad_per_s.size(), count, arm::to_string(sensor), zeros.rejected.size());
  }
  return lines.empty() ? "" : lines + "\n";
}

report::Table certificate_table(const std::vector<CertifiedList>& lists) {
  report::Table table{"Certificate (ball arithmetic)",
                      {{"roots"},
                       {"given"},
                       {"counted"},
                       {"largest error", "ulp of lambda", 2},
                       {"precision", "bit"},
                       {"proved"}}};
  for (const auto& [roots, certificate] : lists) {
    table.add_row({roots, std::int64_t{certificate.given}, std::int64_t{certificate.counted},
                   certificate.largest_distance_ulp, std::int64_t{certificate.precision_bits},
                   certificate.proved ? std::string("yes") : "no: " + certificate.failure});
  }
  return table;
}

nlohmann::ordered_json certificate_json(const std::vector<CertifiedList>& lists) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const auto& [roots, certificate] : lists) {
    nlohmann::ordered_json entry = {{"roots", roots},
                                    {"proved", certificate.proved},
                                    {"failure", certificate.failure},
                                    {"given", certificate.given},
                                    {"counted", certificate.counted},
                                    {"method", certificate.method},
                                    {"largest_distance_ulp", certificate.largest_distance_ulp},
                                    {"precision_bits", certificate.precision_bits},
                                    {"enclosures", nlohmann::ordered_json::array()}};
    for (const auto& root : certificate.roots) {
      entry["enclosures"].push_back({{"lambda", report::complex_json(root.lambda)},
                                     {"radius", root.radius},
                                     {"distance_ulp", root.distance_ulp}});
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

FolderKind modes_folder_kind() {
  return {"the modes of an arm", {"modes.csv"}, {".csv", ".svg", ".pdf", ".png", ".json"}, true};
}

/// The files of one arm, in `folder` of the output folder.
void add_files(const fs::path& folder, const arm::Arm& arm, const std::string& formulation,
               const response::ModalSummary& summary, const FigureChoice& figures,
               std::vector<measured::NamedContent>& files) {
  const auto add_csv = [&](const char* name, const report::Table& table) {
    files.push_back({folder / name, report::to_csv(table)});
  };
  add_csv("modes.csv", report::poles_table(arm, summary));
  add_csv("damped_poles.csv", report::damped_poles_table(summary));
  add_csv("zeros.csv", report::zeros_table(summary));
  add_csv("shapes.csv", report::shapes_over_x_table(summary));
  figures.add_to(files, folder, {{"shapes", report::shapes_figure(formulation, summary)}});
}

/// Shapes are computed where they are written: of many modes they take most of the time.
bool has_shapes(const ModesArguments& arguments) {
  return !arguments.output.folder.empty() || !arguments.output.json_file.empty();
}

/// Measured of 100,000 and 30,000 modes: 5.9 kB a mode, and 25 to 29 kB with what is written.
void require_memory_for_modes(const ModesArguments& arguments) {
  constexpr double kModeBytes = 5e3;
  constexpr double kWrittenModeBytes = 2.5e4;
  require_memory("--modes", arguments.count,
                 arguments.count * (has_shapes(arguments) ? kWrittenModeBytes : kModeBytes));
}

response::ModalSummary summarise_with_progress(const ModesArguments& arguments, const arm::Arm& arm,
                                               const response::AnyFormulation& formulation,
                                               const std::vector<arm::Sensor>& sensors) {
  const auto stations_m = has_shapes(arguments)
                              ? compare::shape_stations_m(arm::linear_arm(arm).length_m)
                              : std::vector<double>{};
  report::Progress progress("computing modes");
  return response::summarise(formulation, arguments.count, sensors, stations_m,
                             [&progress](std::string_view, double fraction) {
                               progress.reach(fraction);
                               return true;
                             });
}

int run_modes(const ModesArguments& arguments) {
  if (arguments.count < 1) throw arm::out_of_range("--modes", arguments.count, "", "1 or more");
  require_memory_for_modes(arguments);
  std::vector<arm::Sensor> sensors;
  for (const auto& name : arguments.sensors) sensors.push_back(arm::parse_sensor(name));

  bool proved = true;
  std::string text;  // printed last: a reader that goes away costs no file
  nlohmann::ordered_json documents = nlohmann::ordered_json::array();
  const auto arms = arguments.arm.arms();
  for (const auto& arm : arms) arm::require_beam(arm, "modes");
  for (const auto& arm : arms) {
    for (const auto& sensor : sensors) arm::require_valid(sensor, arm);
  }
  arguments.output.prepare(modes_folder_kind());
  std::vector<measured::NamedContent> files;
  for (const auto& arm : arms) {
    const auto chosen = arguments.formulation.make(arm, arguments.count);
    const auto summary = summarise_with_progress(arguments, arm, chosen.formulation, sensors);
    const report::Progress forming("forming tables");
    const auto shown = [&arguments](const report::Table& table) {
      return screen_rows(table, arguments.verbose ? kAllRows : kModesRows,
                         "--verbose, --out or --json");
    };
    text += describe(arm);
    text += left_out_of_roots(arm);
    text += fmt::format("by {}\n\n", response::formulation_label(chosen.name, chosen.settings));
    text += shown(report::poles_table(arm, summary));
    const std::string lowest = report::lowest_mode_line(summary);
    if (!lowest.empty()) text += lowest + "\n";
    if (arm::linear_arm(arm).is_damped()) {
      text += shown(report::damped_poles_table(summary));
    }
    text += shown(report::zeros_table(summary));
    text += shortfalls(chosen, summary, arguments.count);

    nlohmann::ordered_json document = {
        {"arm", report::arm_json(arm)}, {"model", chosen.name}, {"settings", chosen.settings}};
    document.update(report::modes_json(arm, summary));
    if (arguments.certificate) {
      const auto lists = certify(arm, sensors, arguments.count);
      text += screen_table(certificate_table(lists));
      document["certificate"] = certificate_json(lists);
      for (const auto& list : lists) proved = proved && list.certificate.proved;
    }
    documents.push_back(std::move(document));

    if (!arguments.output.folder.empty()) {
      add_files(folder_of("", arm, arms.size()), arm, chosen.name, summary,
                arguments.output.figures, files);
    }
  }
  {
    const report::Progress writing("writing files");
    if (!files.empty()) write_folder(arguments.output.folder, arguments.output.force, files);
    if (!arguments.output.json_file.empty()) {
      write_json(arguments.output.json_file,
                 report::json_document("flexarm.modes/1", {{"arms", documents}}));
    }
  }
  if (!arguments.output.folder.empty()) text += fmt::format("wrote {}\n", arguments.output.folder);
  text += fmt::format("next: compare the three formulations with  flexarm compare{}\n",
                      arguments.arm.file.empty() ? "" : " " + arguments.arm.file);
  print(text);
  return proved ? kSuccess : kFailure;
}

}  // namespace

Command add_modes(CLI::App& program) {
  const auto arguments = std::make_shared<ModesArguments>();
  CLI::App* parser =
      program.add_subcommand("modes", "Compute poles, zeros, hub slopes and mode shapes of an arm");
  add_arm_choice(*parser, arguments->arm);
  add_formulation_choice(*parser, arguments->formulation);
  parser->add_option("--modes", arguments->count, "Number of modes, and of zeros per sensor")
      ->capture_default_str();
  add_list_option(*parser, "--sensor", arguments->sensors,
                  "Sensors whose zeros are listed, comma-separated");
  parser->add_flag("--certificate", arguments->certificate,
                   "Certify the roots of exact_tf and their count by ball arithmetic");
  add_verbose(*parser, arguments->verbose, "Print all rows of long tables");
  add_output_choice(*parser, arguments->output, {"Folder for CSV tables and the mode shapes"});
  parser->footer(example("flexarm modes rig.toml --sensor hub_angle,strain@0.05 --certificate"));
  return {parser, [arguments] { return run_modes(*arguments); }};
}

}  // namespace flexarm::app
