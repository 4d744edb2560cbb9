#include "diagnose/experiment.hpp"

#include "arm/input_error.hpp"
#include "arm/plausibility.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/described_arm.hpp"
#include "diagnose/long_runs.hpp"
#include "diagnose/modal_orders.hpp"
#include "measured/checks/run_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

namespace fs = std::filesystem;

/// A channel that does not vary has no noise that it could be weighed by, whatever it shows.
bool is_constant(const measured::TimeRecord& record, const std::string& name) {
  const auto found = std::ranges::find(record.channels, name, [](const measured::Channel& one) {
    return arm::to_string(one.sensor);
  });
  return found != record.channels.end() && std::ranges::all_of(found->values, [&](double value) {
           return value == found->values.front();
         });
}

/// Leaves dead channels and outliers that were `found` out; throws InputError where nothing usable
/// is left.
void keep_usable(Experiment& experiment, measured::MeasuredRun& run, const std::string& file,
                 std::vector<measured::DataFinding> found,
                 const std::vector<measured::Fault>& accepted) {
  auto& record = std::get<measured::TimeRecord>(run.data);
  std::vector<measured::DataFinding> findings;
  for (measured::DataFinding& finding : found) {
    const bool must_go =
        finding.fault == measured::Fault::dead_channel && is_constant(record, finding.channel);
    if (must_go || std::ranges::find(accepted, finding.fault) == accepted.end()) {
      findings.push_back(std::move(finding));
    } else {
      experiment.accepted.push_back({run.run.id, std::move(finding)});
    }
  }
  std::string why;  // the first of the channels left out
  for (const measured::DataFinding& finding : findings) {
    if (finding.fault == measured::Fault::zero_torque) {
      throw arm::InputError(
          fmt::format("{}: run {}: {}; a run without a valid torque cannot be used", file,
                      run.run.id, finding.text));
    }
    const bool is_dead = finding.fault == measured::Fault::dead_channel;
    if (is_dead && why.empty()) why = finding.text;
    experiment.notices.push_back(fmt::format("run {}: {}{}: {}", run.run.id, finding.channel,
                                             is_dead ? " excluded" : "", finding.text));
  }
  for (const measured::DataFinding& finding : findings) {
    const std::size_t outliers = measured::leave_out_spikes(record, finding);
    if (outliers == 0) continue;
    experiment.notices.push_back(
        finding.channel == "torque"
            ? fmt::format("{} of {} samples of the torque in run {} are outliers; their prediction "
                          "takes their place",
                          outliers, record.time_s.size(), run.run.id)
            : fmt::format("{} of {} readings of {} in run {} are outliers and are left out",
                          outliers, record.time_s.size(), finding.channel, run.run.id));
  }
  measured::leave_out_dead_channels(record, findings);
  if (record.channels.empty()) {
    throw arm::InputError(fmt::format(
        "{}: run {}: no usable channel; needs at least one sensor besides time and torque{}", file,
        run.run.id, why.empty() ? "" : fmt::format(": {}", why)));
  }
}

}  // namespace

arm::Arm arm_in(const Experiment& experiment, const measured::Run& run) {
  arm::Arm arm = experiment.arm;
  if (run.payload) arm.payload = *run.payload;
  return arm;
}

bool has_runs(const Experiment& experiment, measured::Purpose purpose, measured::RunKind kind) {
  return std::ranges::any_of(experiment.runs, [&](const auto& run) {
    return run.run.purpose == purpose && run.run.kind == kind;
  });
}

bool has_controllers(const Experiment& experiment) {
  return std::ranges::any_of(experiment.runs,
                             [](const auto& run) { return run.run.controller.has_value(); });
}

Experiment without_controllers(Experiment experiment) {
  for (auto& [run, data] : experiment.runs) {
    run.controller.reset();
    run.reference.reset();
  }
  return experiment;
}

bool holds_are_known(const Experiment& experiment) {
  return std::ranges::all_of(experiment.runs,
                             [](const auto& run) { return run.run.torque_hold_is_known; });
}

Experiment with_hold(Experiment experiment, measured::TorqueHold hold) {
  for (auto& [run, data] : experiment.runs) {
    if (!run.torque_hold_is_known) run.torque_hold = hold;
    run.torque_hold_is_known = true;
  }
  return experiment;
}

Experiment read_experiment(const fs::path& measurement_file,
                           const std::vector<measured::Fault>& accepted,
                           const arm::Deadline& deadline) {
  return experiment_of(compare::read_recording(measurement_file), accepted, deadline);
}

Experiment experiment_of(compare::Recording recording, const std::vector<measured::Fault>& accepted,
                         const arm::Deadline& deadline) {
  Experiment experiment;
  experiment.files = recording.files;
  experiment.arm = recording.arm;
  experiment.notices = arm::plausibility_notes(experiment.arm);
  for (const auto& [name, hypothesis] : experiment.arm.hypotheses) {
    if (!experiment.arm.effects.contains(name)) continue;
    experiment.notices.push_back(fmt::format(
        "effects.{} has a range: it is tested as a hypothesis and is no part of the baseline",
        name));
  }
  experiment.arm = arm::without_hypotheses(experiment.arm);
  experiment.runs = std::move(recording.runs);
  for (const auto& [run, data] : experiment.runs) {
    if (run.kind != measured::RunKind::modal) continue;
    arm::require_beam(experiment.arm,
                      fmt::format("{}: run {}: a modal table", recording.place(), run.id));
  }
  auto findings =
      measured::check_records(experiment.runs, compare::described_arms(experiment.arm), deadline);
  if (arm::is_over(deadline)) {
    experiment.notices.emplace_back("the time limit left no time for all data checks");
  }
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    measured::MeasuredRun& read = experiment.runs[r];
    const std::string file = recording.place(read.run);
    if (read.run.kind == measured::RunKind::time) {
      keep_usable(experiment, read, file, std::move(findings[r]), accepted);
    } else if (auto* table = std::get_if<measured::ModalTable>(&read.data)) {
      for (const std::string& notice : put_orders(arm_in(experiment, read.run), *table)) {
        experiment.notices.push_back(fmt::format("run {}: {}", read.run.id, notice));
      }
      if (table->empty()) {
        throw arm::InputError(fmt::format(
            "{}: run {}: no pole or zero can be assigned to one of the arm; state the orders", file,
            read.run.id));
      }
    }
  }
  const auto split = [&experiment] {
    const std::string done = split_purposes(experiment.runs);
    if (!done.empty()) experiment.notices.push_back(done);
  };
  // A single run that is long has stretches for both purposes.
  if (experiment.runs.size() > 1) split();
  std::ranges::move(cut_long_runs(experiment.runs), std::back_inserter(experiment.notices));
  split();
  const bool fits = std::ranges::any_of(experiment.runs, [](const measured::MeasuredRun& run) {
    return run.run.purpose == measured::Purpose::estimation;
  });
  if (!fits) {
    throw arm::InputError(fmt::format(
        "{}: run.purpose: all runs are validation runs; needs at least one estimation run",
        recording.place()));
  }
  return experiment;
}

std::string split_purposes(std::vector<measured::MeasuredRun>& runs) {
  using measured::Purpose;
  const bool validates = std::ranges::any_of(
      runs, [](const auto& run) { return run.run.purpose == Purpose::validation; });
  std::vector<std::size_t> unsaid;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].run.purpose) continue;
    unsaid.push_back(i);
    runs[i].run.purpose = Purpose::estimation;
  }
  if (validates || unsaid.empty()) return {};
  if (runs.size() < 2) {
    return fmt::format("run {} is the only run and is used for estimation; there is no validation",
                       runs.front().run.id);
  }
  // The condition with most runs can spare one: the last of them.
  const auto same_payload = [&](std::size_t i) {
    return std::ranges::count_if(
        unsaid, [&](std::size_t k) { return runs[k].run.payload == runs[i].run.payload; });
  };
  std::size_t spared = unsaid.front();
  for (const std::size_t i : unsaid) {
    if (same_payload(i) >= same_payload(spared)) spared = i;
  }
  runs[spared].run.purpose = Purpose::validation;
  return fmt::format(
      "no validation run given; {} is used for validation, the others for estimation",
      runs[spared].run.id);
}

}  // namespace flexarm::diagnose
