#include "report/measurement_folder.hpp"

#include "measured/files/arm_file.hpp"
#include "measured/files/measurement.hpp"
#include "report/tables/simulation_report.hpp"
#include "report/tables/stepped_sine_report.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace flexarm::report {

std::vector<measured::NamedContent> measurement_folder(
    const std::string& name, const arm::Arm& written_arm,
    const std::vector<experiment::PlannedRun>& plan,
    const experiment::SimulatedExperiment& experiment, response::TorqueHold hold,
    const FigureOptions& figures) {
  measured::Measurement measurement{name, "arm.toml", {}};
  std::vector<measured::NamedContent> files;
  // Run by run: a figure holds its record.
  const auto add_figures = [&](const std::vector<NamedFigure>& of_run) {
    std::ranges::move(figure_files(of_run, figures), std::back_inserter(files));
  };
  auto in_time = experiment.runs.begin();
  auto stepped = experiment.stepped_runs.begin();
  for (const auto& planned : plan) {
    measured::Run entry;
    entry.id = planned.id;
    entry.file = planned.id + ".csv";
    entry.purpose = planned.purpose;
    entry.payload = planned.payload;
    if (planned.stepped_sine) {
      entry.kind = measured::RunKind::frf;
      files.push_back({entry.file, measured::format_frequency_record(frequency_record(*stepped))});
      add_figures(stepped_sine_plots(written_arm.name, *stepped));
      ++stepped;
    } else {
      entry.torque_hold = hold == response::TorqueHold::zero ? measured::TorqueHold::zero
                                                             : measured::TorqueHold::first;
      if (planned.controller) {
        entry.controller = planned.controller;
        entry.reference = measured::ColumnMapping{std::string(measured::kReferenceColumn), "", 1.0};
      }
      files.push_back({entry.file, measured::format_time_record(in_time->record)});
      add_figures({{planned.id, simulation_figure(written_arm.name, *in_time)}});
      ++in_time;
    }
    measurement.runs.push_back(std::move(entry));
  }
  files.push_back({"arm.toml", measured::format_arm(written_arm)});
  files.push_back({"measurement.toml", measured::format_measurement(measurement)});
  return files;
}

std::string simulated_name(const arm::Arm& arm) {
  return arm.name.empty() ? "simulated" : arm.name + ", simulated";
}

}  // namespace flexarm::report
